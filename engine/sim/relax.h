// SPDX-License-Identifier: GPL-3.0-or-later
// Brings a sewn garment to rest: quasi-Newton with a prefactored matrix, contact forces and friction frozen in rounds.
// Source: design/sewing.md F.
#pragma once

#include "engine/core/progress.h"
#include "engine/sim/drape_energy.h"
#include "engine/sim/quasi_newton.h"

namespace toile {

struct RelaxOptions {
  int iterations = 800;        // at most, over all rounds
  int round = 200;             // iterations after which friction is frozen anew
  int refactor = 100;          // iterations after which the matrix takes up the present contacts
  double stop_residual = 0.3;  // of a mean node weight (DrapeEnergy::residual)
  QuasiNewtonOptions quasi_newton;
};

struct RelaxResult {
  Points3 nodes;          // #N x 3
  double residual = 0.0;  // see DrapeEnergy::residual
  double energy = 0.0;    // J
  int iterations = 0;
  int evaluations = 0;
  bool stalled = false;  // the line search found no further decrease
};

RelaxResult relax(DrapeEnergy& energy, const Points3& start, const RelaxOptions& options, Progress* progress);

}  // namespace toile
