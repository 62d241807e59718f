// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's own drape: position-based dynamics by averaged targets. Every face normalises the columns of its Jacobian
// (fibres do not stretch beyond delta), clamps their angle to 90 degrees +- rho, and places the corrected triangle by
// Procrustes; a node moves to the mean of its faces' targets. Folds sharper than a threshold are opened. Nodes closer
// to the body than the thickness move out along the field's gradient. No self-collision, no friction. Reaches
// equilibrium far more slowly than relax(): it is here to compare with. Source: [Eggler2024, Sec. 7].
#pragma once

#include "engine/core/progress.h"
#include "engine/sim/drape_energy.h"

namespace toile {

struct PositionBasedOptions {
  int iterations = 1000;     // >= 0
  double fibre_slack = 0.0;  // delta: stretch a fibre gives for nothing, dimensionless, 0..0.2; 0 for fitting maps
  double shear_limit = 0.2094395102;  // rho, rad: 12 degrees
  double fold_limit = 1.5707963268;   // rad between the normals of neighbours beyond which a fold is opened
  double time_step = 0.005;           // s, of the fall under gravity
  double gravity = 9.81;              // m/s^2
};

// Nodes after the iterations; `holds` keep theirs from sinking, `pins` are fixed.
Points3 position_based(const DrapeEnergy& garment, SignedField& field, double thickness, const Points3& start,
                       const PositionBasedOptions& options, Progress* progress);

}  // namespace toile
