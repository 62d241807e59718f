// SPDX-License-Identifier: GPL-3.0-or-later
// A closed polygon grown outwards, each segment by its own distance, with mitred corners.
#pragma once

#include "engine/core/types.h"

namespace toile {

// `polygon` runs counter-clockwise, is simple and does not repeat its first point; distances[i] >= 0 belongs to the
// segment from point i to point i + 1. Points and distances in one unit.
// Corners are mitred: the two grown segments meet where their lines cross, but no farther from the corner than
// `mitre_limit` times the larger distance, where the tip is cut square. Where the outline is hollow, grown parts that
// would run into each other are joined (the result is the outer outline of everything within the distances).
// Same unit and orientation out. Throws Error{Internal} if the counts differ.
std::vector<Vec2> offset_polygon(const std::vector<Vec2>& polygon, const std::vector<double>& distances,
                                 double mitre_limit = 3.0);

// The signed area of a closed polygon: > 0 where it runs counter-clockwise.
double polygon_area(const std::vector<Vec2>& polygon);

}  // namespace toile
