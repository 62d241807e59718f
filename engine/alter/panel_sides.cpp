// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/panel_sides.h"

#include <algorithm>

#include "engine/core/units.h"

namespace toile {
namespace {

struct OutlineEdge {
  int edge;
  std::vector<int> vertices;  // counter-clockwise
};

// The panel's edges that have a length, counter-clockwise.
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

bool turns_between(const PatternMesh& mesh, const OutlineEdge& before, const OutlineEdge& after) {
  const auto at = [&](int v) { return Vec2(mesh.rest.row(v)); };
  const Vec2 in = at(before.vertices.back()) - at(before.vertices[before.vertices.size() - 2]);
  const Vec2 out = at(after.vertices[1]) - at(after.vertices[0]);
  const double angle = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  return std::abs(angle) >= kCornerTurn * kRadianPerDegree;
}

bool edge_is_sewn(const Pattern& pattern, const SeamSide& side) {
  return std::any_of(pattern.seams.begin(), pattern.seams.end(),
                     [&](const Seam& seam) { return seam.a == side || seam.b == side; });
}

void append(PanelSide& side, const OutlineEdge& edge, const Pattern& pattern, int panel) {
  side.edges.push_back(edge.edge);
  side.vertices.insert(side.vertices.end(), edge.vertices.begin() + (side.vertices.empty() ? 0 : 1),
                       edge.vertices.end());
  const SeamSide name{PanelId(panel), edge.edge};
  side.locked = side.locked || pattern.edge(name).locked || pattern.edge(name).zip;
  side.sewn = side.sewn || edge_is_sewn(pattern, name);
}

}  // namespace

std::vector<PanelSide> find_panel_sides(const Pattern& pattern, const PatternMesh& mesh, int panel) {
  const std::vector<OutlineEdge> edges = outline_edges(mesh, panel);
  const std::size_t count = edges.size();
  std::size_t first = 0;  // an edge that begins at a corner
  for (std::size_t k = 0; k < count; ++k)
    if (turns_between(mesh, edges[(k + count - 1) % count], edges[k])) {
      first = k;
      break;
    }
  std::vector<PanelSide> sides;
  for (std::size_t i = 0; i < count; ++i) {
    const OutlineEdge& edge = edges[(first + i) % count];
    if (sides.empty() || turns_between(mesh, edges[(first + i + count - 1) % count], edge)) sides.emplace_back();
    append(sides.back(), edge, pattern, panel);
  }
  return sides;
}

std::vector<std::vector<SeamPartner>> find_seam_partners(const PatternMesh& mesh) {
  std::vector<std::vector<SeamPartner>> partners(static_cast<std::size_t>(mesh.vertex_count()));
  const auto add = [&](int from, int to) {
    auto& list = partners[static_cast<std::size_t>(from)];
    for (const SeamPartner& known : list)
      if (known.vertex == to) return;
    list.push_back({mesh.panel_of_vertex[static_cast<std::size_t>(to)], to});
  };
  for (const auto& seam : mesh.seam_vertices)
    for (const auto& [a, b] : seam)
      if (a != b) {
        add(a, b);
        add(b, a);
      }
  return partners;
}

}  // namespace toile
