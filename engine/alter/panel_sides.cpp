// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/panel_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/alter/panel_outline.h"
#include "engine/core/units.h"

namespace toile {
namespace {

bool edge_is_sewn(const Pattern& pattern, const SeamSide& side) {
  return std::any_of(pattern.seams.begin(), pattern.seams.end(),
                     [&](const Seam& seam) { return seam.a == side || seam.b == side; });
}

// The ply that is sewn to a zip is not opened either.
bool is_sewn_to_zip(const Pattern& pattern, const SeamSide& side) {
  return std::any_of(pattern.seams.begin(), pattern.seams.end(), [&](const Seam& seam) {
    return (seam.a == side && pattern.edge(seam.b).zip) || (seam.b == side && pattern.edge(seam.a).zip);
  });
}

void append_vertices(PanelSide& side, const OutlineEdge& edge) {
  // Across the mouth of a wedge the side goes on with a vertex of its own.
  const bool joined = !side.vertices.empty() && side.vertices.back() == edge.vertices.front();
  side.vertices.insert(side.vertices.end(), edge.vertices.begin() + (joined ? 1 : 0), edge.vertices.end());
}

void append(PanelSide& side, const OutlineEdge& edge, const Pattern& pattern, int panel) {
  side.edges.push_back(edge.edge);
  append_vertices(side, edge);
  const SeamSide name{PanelId(panel), edge.edge};
  side.locked = side.locked || pattern.edge(name).locked || pattern.edge(name).zip || is_sewn_to_zip(pattern, name);
  side.sewn = side.sewn || edge_is_sewn(pattern, name);
}

constexpr double kWedgeTurn = 45.0;  // degrees: a side goes on across a wedge that turns it less

bool is_leg(const std::vector<DartWedge>& wedges, int edge) {
  return std::any_of(wedges.begin(), wedges.end(),
                     [&](const DartWedge& wedge) { return wedge.edges[0] == edge || wedge.edges[1] == edge; });
}

}  // namespace

std::vector<PanelSide> find_panel_sides(const Pattern& pattern, const PatternMesh& mesh, int panel,
                                        const std::vector<DartWedge>& wedges) {
  std::vector<OutlineEdge> edges = outline_edges(mesh, panel);
  std::erase_if(edges, [&](const OutlineEdge& edge) { return is_leg(wedges, edge.edge); });
  const std::size_t count = edges.size();
  const auto corner = [&](std::size_t k) {  // where edge k begins
    const OutlineEdge& before = edges[(k + count - 1) % count];
    const double limit = before.vertices.back() == edges[k].vertices.front() ? kCornerTurn : kWedgeTurn;
    return std::abs(turn_between(mesh.rest, before, edges[k])) >= limit * kRadianPerDegree;
  };
  std::size_t first = 0;
  while (first + 1 < count && !corner(first)) ++first;
  if (!corner(first)) first = 0;
  std::vector<PanelSide> sides;
  for (std::size_t i = 0; i < count; ++i) {
    if (sides.empty() || corner((first + i) % count)) sides.emplace_back();
    append(sides.back(), edges[(first + i) % count], pattern, panel);
  }
  for (const DartWedge& wedge : wedges)
    for (PanelSide& side : sides)
      if (side.holds(wedge.legs[0].front()) && side.holds(wedge.legs[1].front()))
        for (const int edge : wedge.edges) {
          const PanelEdge& leg = pattern.panels[static_cast<std::size_t>(panel)].edges[static_cast<std::size_t>(edge)];
          side.locked = side.locked || leg.locked || leg.zip;
        }
  return sides;
}

double allowance_of(const Pattern& pattern, int panel, const PanelSide& side) {
  double least = std::numeric_limits<double>::infinity();
  for (const int number : side.edges) {
    const PanelEdge& edge = pattern.edge({PanelId(panel), number});
    const double own = edge.hem ? *edge.hem : edge.seam_allowance.value_or(pattern.seam_allowance);
    least = std::min(least, edge.on_fold ? 0.0 : own);
  }
  return std::isfinite(least) ? least : 0.0;
}

std::vector<double> side_rooms(const Pattern& pattern, int panel, const std::vector<PanelSide>& sides, double left) {
  std::vector<double> rooms;
  for (const PanelSide& side : sides) rooms.push_back(allowance_of(pattern, panel, side) - left);
  return rooms;
}

std::vector<PanelSide> same_sides(std::vector<PanelSide> sides, const PatternMesh& mesh, int panel) {
  const std::vector<OutlineEdge> edges = outline_edges(mesh, panel);
  for (PanelSide& side : sides) {
    side.vertices.clear();
    for (const int number : side.edges)
      for (const OutlineEdge& edge : edges)
        if (edge.edge == number) append_vertices(side, edge);
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
