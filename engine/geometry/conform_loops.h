// SPDX-License-Identifier: GPL-3.0-or-later
// Give closed polygons that touch common points: where the border of one runs along that of another, both have the
// same points and segments. Any length unit.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

struct ConformedLoops {
  std::vector<Vec2> points;
  std::vector<std::vector<int>> loops;  // in the order given; may be empty where nothing of a loop was left
};

// Points nearer than `tolerance` become one; a point that near to the inside of a segment becomes a point of it. A loop
// of one point only adds that point. Spikes of no width are taken off. Deterministic.
ConformedLoops conform_loops(const std::vector<std::vector<Vec2>>& loops, double tolerance);

}  // namespace toile
