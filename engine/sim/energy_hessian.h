// SPDX-License-Identifier: GPL-3.0-or-later
// Exact second derivatives of the energies of a drape, term by term, in the notation of membrane.h and contact.h. Each
// adds its blocks to a BlockHessian. With Curvature::Projected every element's own negative curvature is set to zero,
// so that the sum is positive semidefinite; with Curvature::Exact it is the derivative of the gradient.
#pragma once

#include "engine/sim/block_hessian.h"

namespace toile {

enum class Curvature { Exact, Projected };

void add_membrane_hessian(const Cloth& cloth, const Points3& nodes, Curvature curvature, BlockHessian& hessian);
void add_bending_hessian(const Cloth& cloth, BlockHessian& hessian);

// Of one node's contact k f(t - phi) as the depth d = t - phi says, `normal` and `bend` the field's gradient and
// Hessian.
Mat3 contact_hessian(double stiffness, double depth, double linear_beyond, const Vec3& normal, const Mat3& bend,
                     Curvature curvature);
// Of one node's friction load s(|u|) at the tangential slip u on the plane of `normal`; never negative.
Mat3 friction_hessian(double load, double slip_length, const Vec3& slip, const Vec3& normal);

}  // namespace toile
