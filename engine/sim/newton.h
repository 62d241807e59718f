// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method with a line search on the energy of a drape, contacts and friction anchors as they are frozen: the
// measure of every other solver's error. The matrix is exact + s (projected - exact) + a vanishing weight term, s the
// least share found to make it positive definite: far from rest it is the projected Hessian, at rest the exact one.
// Source: [Teran2005] (projection), [Hager2005] (the line search where energies differ by rounding alone).
#pragma once

#include <vector>

#include "engine/core/progress.h"
#include "engine/sim/drape_energy.h"

namespace toile {

struct NewtonOptions {
  int iterations = 300;         // at most, >= 0
  double stop_residual = 1e-6;  // of a mean node weight (DrapeEnergy::residual), > 0
  double largest_move = 0.03;   // of any node in one iteration, m
};

struct NewtonResult {
  Points3 nodes;          // #N x 3
  double residual = 0.0;  // see DrapeEnergy::residual
  double energy = 0.0;    // J
  int iterations = 0;     // steps taken
  int evaluations = 0;
  int factorisations = 0;
  bool converged = false;
  bool stalled = false;           // no descent could be found
  std::vector<double> energies;   // J, at the start and after every step
  std::vector<double> residuals;  // the same
};

// Throws Error{Cancelled}.
NewtonResult newton(DrapeEnergy& energy, const Points3& start, const NewtonOptions& options, Progress* progress);

}  // namespace toile
