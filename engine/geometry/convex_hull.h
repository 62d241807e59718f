// SPDX-License-Identifier: GPL-3.0-or-later
// Convex hull of points in the plane.
#pragma once

#include "engine/core/types.h"

namespace toile {

// Corners of the hull, counter-clockwise from the leftmost point, no three on a line. Fewer than three for degenerate
// input.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

// Length of the hull's border: what a tight tape measures. 0 for fewer than two points; twice the length for a segment.
double hull_perimeter(std::vector<Vec2> points);

}  // namespace toile
