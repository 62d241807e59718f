// SPDX-License-Identifier: GPL-3.0-or-later
// What friction holds a cloth by, as one freeze left it: to go on from there on another mesh. SI units.
#pragma once

#include "engine/core/types.h"

namespace toile {

struct FrictionState {
  Eigen::VectorXd load;    // #N, friction coefficient times contact force, N; 0: not held
  Points3 anchor, normal;  // #N x 3: where a node sticks, and the unit normal of the plane in which it may slip
};

}  // namespace toile
