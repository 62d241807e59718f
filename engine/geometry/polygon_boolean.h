// SPDX-License-Identifier: GPL-3.0-or-later
// Union, difference and intersection of plane polygons in exact arithmetic, so that shared edges and touching corners
// leave no slivers. Coordinates are snapped to a grid of 2^-30 (about a nanometre in metres) on the way in.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

// A region with holes: the outline counter-clockwise, every hole clockwise, none closed by repeating its first point.
struct PolygonWithHoles {
  std::vector<Vec2> outline;
  std::vector<std::vector<Vec2>> holes;
};

double signed_area(const std::vector<Vec2>& loop);  // > 0 counter-clockwise
double area(const PolygonWithHoles& polygon);
double area(const std::vector<PolygonWithHoles>& polygons);
bool is_simple_polygon(const std::vector<Vec2>& loop);  // exact; false when it touches or crosses itself

// Each operand is a list of loops, of either orientation, together the union of what they enclose; a loop that crosses
// itself is taken as the union of the areas it winds around. Throws GarmentInvalid when a coordinate is not finite.
using Loops = std::vector<std::vector<Vec2>>;
std::vector<PolygonWithHoles> polygon_union(const Loops& a);
std::vector<PolygonWithHoles> polygon_difference(const Loops& a, const Loops& b);
std::vector<PolygonWithHoles> polygon_intersection(const Loops& a, const Loops& b);

}  // namespace toile
