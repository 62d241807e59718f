// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles meet along which edge. Half-edge 3 f + k runs from corner k of triangle f to corner (k + 1) % 3.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

inline int next_half_edge(int h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
inline int half_edge_start(const Triangles& triangles, int h) {
  return triangles(h / 3, h % 3);
}
inline int half_edge_end(const Triangles& triangles, int h) {
  return triangles(h / 3, (h + 1) % 3);
}

struct HalfEdges {
  static constexpr int kBoundary = -1;  // the edge of one triangle only
  static constexpr int kTangled = -2;   // an edge of more than two triangles

  std::vector<int> opposite;  // #F * 3 -> the half-edge of the other triangle, or one of the marks above

  // Whether two triangles run along their common edge in the same direction: one of them is inside out.
  bool is_twisted(const Triangles& triangles, int h) const {
    const int other = opposite[static_cast<std::size_t>(h)];
    return other >= 0 && half_edge_start(triangles, h) == half_edge_start(triangles, other);
  }
};

// Requires triangles without repeated corners.
HalfEdges find_half_edges(const Triangles& triangles);

// The loops of open edges as vertices, each in the direction of its half-edges (the hole lies to the right of them).
// Requires one boundary loop at most through every vertex; loops are ordered by their lowest half-edge.
std::vector<std::vector<int>> boundary_loops(const Triangles& triangles, const HalfEdges& edges);

// What stands between a triangle set and a closed, consistently oriented two-manifold.
struct SurfaceDefects {
  int open_edges = 0;
  int tangled_edges = 0;     // of more than two triangles
  int twisted_edges = 0;     // of two triangles that disagree in orientation
  int pinched_vertices = 0;  // where separate fans of triangles meet
  bool none() const { return open_edges + tangled_edges + twisted_edges + pinched_vertices == 0; }
};
SurfaceDefects find_defects(int vertex_count, const Triangles& triangles);

// The fan of triangles each corner belongs to: #F * 3 -> a representative corner (3 f + k) at the same vertex.
std::vector<int> corner_fans(const Triangles& triangles, const HalfEdges& edges);

}  // namespace toile
