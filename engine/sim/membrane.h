// SPDX-License-Identifier: GPL-3.0-or-later
// Stretch and shear of cloth: E = sum A/2 [ ku (|Fu| - 1)^2 + kv (|Fv| - 1)^2 + ks |F - R|^2 ], F the 3x2 deformation
// gradient in the grain's frame, R its closest rotation (corotational shear). J; stiffnesses in N/m (fabric.h).
// Zero for rigid motion; once continuously differentiable wherever no column of F vanishes; collapsed triangles are
// smoothed below 1e-5 of their area, so that the gradient is always finite.
#pragma once

#include "engine/sim/cloth.h"

namespace toile {

// Added to det(F^T F), dimensionless: keeps the rotation of a collapsed triangle defined.
inline constexpr double kMembraneCollapse = 1e-10;
// Added to |Fu|^2 and |Fv|^2, dimensionless: keeps the direction of a vanished fibre finite.
inline constexpr double kMembraneLeastLengthSquared = 1e-24;

// Adds the gradient to `gradient` (#N x 3, N) and returns the energy.
double membrane_energy_gradient(const Cloth& cloth, const Points3& nodes, Points3& gradient);

// The constant matrix of the local/global steps: an upper bound of the membrane's Hessian for every coordinate where
// the cloth is in tension, sum A [ (ku + ks) gu gu^T + (kv + ks) gv gv^T ], lower triangle, every diagonal present.
// N/m.
SparseMatrix membrane_bound(const Cloth& cloth);

}  // namespace toile
