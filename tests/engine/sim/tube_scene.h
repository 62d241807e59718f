// SPDX-License-Identifier: GPL-3.0-or-later
// A skirt wound round a cylinder at any distance from it.
#pragma once

#include "engine/sim/cloth.h"
#include "tests/support/tubes.h"

namespace toile::test {

inline constexpr double kRadius = 0.14;  // of the cylinder, m

struct TubeScene {
  Pattern pattern = tube_skirt_pattern(0.9, 0.3, 0.1, 0.2);
  PatternMesh mesh = structured_mesh(pattern, 6, 4);
  Cloth cloth = make_cloth(pattern, mesh);
  CylinderField field{kRadius};
  Points3 at(double radius) const {
    return wrapped_tube(
               pattern, mesh, [radius](double) { return radius; }, 0.1)
        .nodes;
  }
};

}  // namespace toile::test
