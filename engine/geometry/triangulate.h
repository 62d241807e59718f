// SPDX-License-Identifier: GPL-3.0-or-later
// Constrained Delaunay triangulation of a region of the plane.
#pragma once

#include <array>
#include <vector>

#include "engine/core/types.h"

namespace toile {

// Triangles (counter-clockwise, indices into `points`) of the region that lies inside an odd number of the closed loops
// formed by `segments`; every segment is an edge of the triangulation, all other edges are Delaunay.
// Requires: distinct points; segments that meet only at their ends and form closed loops.
// Throws Error{GarmentInvalid} when segments cross or pass through a point.
Triangles triangulate(const std::vector<Vec2>& points, const std::vector<std::array<int, 2>>& segments);

}  // namespace toile
