// SPDX-License-Identifier: GPL-3.0-or-later
// Closes the seams of an arranged garment without gravity and friction: the membrane's own descent in a prefactored
// matrix, contact by ADMM with a falling penalty. Not an equilibrium solver: it hands a clean start to the drape.
//   x += K^-1 ( -grad E + ku sigma A (z - u - x) );  q = r x + (1 - r) z;  z = push_out(q + u);  u += q - z
//   K = bounds of membrane and bending + ku sigma diag(A)
// Source: design/sewing.md E.
#pragma once

#include "engine/core/progress.h"
#include "engine/sim/drape_energy.h"

namespace toile {

struct SewingStage {
  double sigma;       // contact penalty over the weft stiffness, 1/m^2
  double relaxation;  // r, 1..1.8
  int iterations;     // at most
};

struct SewingOptions {
  std::vector<SewingStage> stages = {{3000, 1.0, 60}, {1000, 1.0, 30}, {300, 1.6, 150}};
  double stop_move = 0.0005;  // largest move of a node in one iteration that counts as closed, m; last stage only
  int push_steps = 4;         // Newton steps of push_out
  double push_cap = 0.03;     // of one of them, m
};

struct SewingResult {
  Points3 nodes;  // #N x 3
  int iterations = 0;
  double last_move = 0.0;  // m
};

// `energy`: membrane and bending of the cloth, no gravity; its contact is not used, only `field` and `thickness`.
// `start` and the result: of the whole garment, also where the energy is that of a half.
SewingResult sew(DrapeEnergy& energy, SignedField& field, double thickness, const Points3& start,
                 const SewingOptions& options, Progress* progress);

}  // namespace toile
