// SPDX-License-Identifier: GPL-3.0-or-later
// The first triangles over a hole: a polygon in space as a set of triangles without new vertices.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/types.h"

namespace toile {

// A boundary loop seen from the hole: its vertices in the order in which the new triangles run along it.
struct HoleLoop {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  // i: unit normal of the surface across the edge from point i to i + 1
  // Whether the surface already joins points i and j (other than by the loop's own edges): no diagonal may.
  std::function<bool(int i, int j)> joined;
};

// Triangles (i, j, k) of loop positions, oriented along the loop: size - 2 of them. Empty if no set of free diagonals
// exists. Minimises the worst fold between neighbouring triangles (and the surface), then the area [Liepa2003, Sec. 3].
// Loops of more than `exact_size` points are first cut at free diagonals between near points.
std::vector<Eigen::Vector3i> triangulate_hole(const HoleLoop& loop, int exact_size = 120);

}  // namespace toile
