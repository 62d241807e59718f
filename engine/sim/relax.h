// SPDX-License-Identifier: GPL-3.0-or-later
// Brings a sewn garment to rest: quasi-Newton with a prefactored matrix, contact forces and friction frozen in rounds.
// Source: design/sewing.md F.
#pragma once

#include "engine/core/progress.h"
#include "engine/sim/drape_energy.h"
#include "engine/sim/quasi_newton.h"

namespace toile {

struct RelaxOptions {
  int iterations = 1500;       // at most, over all rounds
  int first_round = 100;       // iterations with the friction of the start
  int round = 50;              // iterations after which friction is frozen anew and the settling is looked at
  int refactor = 100;          // iterations after which the matrix takes up the present contacts
  int look_around = 10;        // iterations for which self-contact keeps its pairs; longer where little has moved
  int look_soon = 2;           // the same where a pair has stopped a node
  double stop_residual = 0.3;  // of a mean node weight (DrapeEnergy::residual), with friction just frozen
  // Of all nodes but the worst fiftieth: a knot of a few crossing layers may push for ever without moving anything.
  double settled_residual = 2.6;    // below it and without movement the drape counts as settled
  double settled_everywhere = 3.0;  // the same of all nodes
  double settled_move = 0.0005;     // m a watched line may move over a round and still count as settled
  // Cloth that swings along a soft valley has next to no residual: the moves of the last two rounds, continued as a
  // geometric series, must come to less (m, root mean square of the nodes) before it is left at that. The series may
  // be too short by half: 2.3 mm were left of a dress for which it said less than 2.
  double settled_swing = 0.001;
  double stop_settled = 0.0;              // the same residual below which a settled drape is left at that; 0: never
  int least_iterations = 300;             // before it may count as settled: below, even placement is not settled
  std::vector<std::vector<int>> watched;  // lines of nodes whose mean position tells whether the garment still moves
  QuasiNewtonOptions quasi_newton;
};

struct RelaxResult {
  Points3 nodes;           // #N x 3
  double residual = 0.0;   // see DrapeEnergy::residual
  double last_move = 0.0;  // largest move of a watched line over the last full round, m
  double energy = 0.0;     // of the whole garment, J
  int iterations = 0;
  int evaluations = 0;
  bool converged = false;  // stop_residual reached with friction just frozen
  bool settled = false;    // settled_residual and settled_move reached over a full round
  bool stalled = false;    // no further decrease could be found, or it gets nowhere (standstill.h)
  bool tangled = false;    // it gets nowhere for layers that do not come free
};

// `start` and the result: of the whole garment, also where the energy is that of a half.
RelaxResult relax(DrapeEnergy& energy, const Points3& start, const RelaxOptions& options, Progress* progress);

}  // namespace toile
