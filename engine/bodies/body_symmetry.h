// SPDX-License-Identifier: GPL-3.0-or-later
// The plane about which a standing body is most symmetric.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct BodySymmetry {
  double yaw = 0.0;       // rad about +Y: turning the body by it brings the mid-plane to x = offset
  double lean = 0.0;      // rad: after the turn the mid-plane's normal is (cos lean, sin lean, 0); 0 where it is small
  double offset = 0.0;    // m, distance of the mid-plane from the origin along that normal
  double residual = 0.0;  // m, median distance of the mirrored body to the body
};

// Starts from the principal axes of the surface seen from above (the long one is lateral), then registers the mirrored
// body to the body: turn about Y and shift along x and z, point to plane, distant matches weighted down. Where that
// leaves much, the body may lean to a side: then all turns and shifts. Front and back are not told apart. Requires:
// metres, Y up. Source: shared design page "registration", section 1.1.
BodySymmetry find_symmetry(const TriangleMesh& body);

}  // namespace toile
