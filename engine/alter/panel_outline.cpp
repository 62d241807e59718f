// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/panel_outline.h"

#include <algorithm>
#include <cmath>

namespace toile {

std::vector<OutlineEdge> outline_edges(const PatternMesh& mesh, int panel) {
  std::vector<OutlineEdge> edges;
  const auto& all = mesh.edge_vertices[static_cast<std::size_t>(panel)];
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].size() > 1) edges.push_back({static_cast<int>(k), all[k]});
  if (mesh.panel_reversed[static_cast<std::size_t>(panel)]) {
    std::reverse(edges.begin(), edges.end());
    for (OutlineEdge& edge : edges) std::reverse(edge.vertices.begin(), edge.vertices.end());
  }
  return edges;
}

double turn_between(const Points2& rest, const OutlineEdge& before, const OutlineEdge& after) {
  const auto at = [&](int v) { return Vec2(rest.row(v)); };
  const Vec2 in = at(before.vertices.back()) - at(before.vertices[before.vertices.size() - 2]);
  const Vec2 out = at(after.vertices[1]) - at(after.vertices[0]);
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

}  // namespace toile
