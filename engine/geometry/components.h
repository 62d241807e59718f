// SPDX-License-Identifier: GPL-3.0-or-later
// Connected pieces of a triangle surface.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Twice the vector area of triangle f: its direction is the outer normal.
Vec3 triangle_cross(const TriangleMesh& mesh, int f);

struct MeshComponents {
  std::vector<int> of_triangle;  // #F -> component; components are numbered by falling area
  std::vector<double> area;      // per component, m^2
};

// Triangles that share a vertex are connected.
MeshComponents find_components(const TriangleMesh& mesh);

// The triangles for which `keep` holds, with only the vertices they use, both in their old order.
TriangleMesh extract_triangles(const TriangleMesh& mesh, const std::vector<bool>& keep);

}  // namespace toile
