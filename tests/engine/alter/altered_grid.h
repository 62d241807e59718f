// SPDX-License-Identifier: GPL-3.0-or-later
// Alterations of garments of rectangles to a map of each panel's plane.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "tests/support/grid_garment.h"

namespace toile::test {

using Map = std::function<Vec2(int panel, const Vec2&)>;

inline constexpr double kPerCm2 = 1e4;  // square centimetres of a square metre

inline AlterPatternResult alter(const GridGarment& garment, const Map& map, const AlterPatternOptions& options = {}) {
  return alter_pattern(garment.pattern, garment.mesh, garment.mapped(map), options);
}

}  // namespace toile::test
