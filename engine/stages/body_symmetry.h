// SPDX-License-Identifier: GPL-3.0-or-later
// The vertical plane about which a standing body is most symmetric.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct BodySymmetry {
  double yaw = 0.0;       // rad about +Y: turning the body by it brings the mid-plane to x = offset
  double offset = 0.0;    // m, x of the mid-plane after the turn
  double residual = 0.0;  // m, median distance of the mirrored body to the body
};

// Starts from the principal axes of the surface seen from above (the long one is lateral), then registers the mirrored
// body to the body: turn about Y and shift along x and z, point to plane, distant matches weighted down. Front and back
// are not told apart. Requires: metres, Y up. Source: shared design page "registration", section 1.1.
BodySymmetry find_symmetry(const TriangleMesh& body);

}  // namespace toile
