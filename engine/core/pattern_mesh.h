// SPDX-License-Identifier: GPL-3.0-or-later
// The panels as triangles, and how their vertices are sewn into garment nodes.
#pragma once

#include <utility>

#include "engine/core/ids.h"
#include "engine/core/types.h"

namespace toile {

// Vertices and triangles of one panel are contiguous: [begin, end).
struct PanelRange {
  int vertex_begin = 0, vertex_end = 0;
  int triangle_begin = 0, triangle_end = 0;
};

struct PatternMesh {
  Points2 rest;         // #V x 2, pattern vertices in their panel's frame (u = x = weft, v = y = warp, m)
  Triangles triangles;  // #F x 3 into `rest`, counter-clockwise in the panel plane: det Dm > 0 for every triangle

  std::vector<PanelRange> panels;      // one per panel of the pattern
  std::vector<int> panel_of_vertex;    // #V
  std::vector<int> panel_of_triangle;  // #F
  std::vector<bool> panel_reversed;    // per panel: its outline runs clockwise, so its right side faces -z of its plane

  // Per panel and edge: the pattern vertices along it, from the edge's start to its end, both ends included.
  // A collapsed edge holds one vertex. Together they are the panel's boundary loop in the order of its edges.
  std::vector<std::vector<std::vector<int>>> edge_vertices;

  // Per seam of the pattern: the pattern vertices that meet, in order along side `a` from its start.
  std::vector<std::vector<std::pair<int, int>>> seam_vertices;

  std::vector<int> node_of_vertex;  // #V -> garment node, 0..node_count-1; sewn vertices share a node
  int node_count = 0;

  double target_edge_length = 0.0;  // m, that the mesh was made for

  int vertex_count() const { return static_cast<int>(rest.rows()); }
  int triangle_count() const { return static_cast<int>(triangles.rows()); }

  // Corners of a triangle as garment nodes.
  Eigen::Vector3i nodes_of_triangle(int f) const {
    return {node_of_vertex[static_cast<std::size_t>(triangles(f, 0))],
            node_of_vertex[static_cast<std::size_t>(triangles(f, 1))],
            node_of_vertex[static_cast<std::size_t>(triangles(f, 2))]};
  }
};

}  // namespace toile
