// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/dart_wedges.h"

#include <algorithm>
#include <cmath>

#include "engine/alter/panel_outline.h"
#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kApexTurn = 120.0;  // degrees at least: the legs lead back out
constexpr double kSideTurn = 45.0;   // degrees at most from the side before the wedge to that behind it
constexpr double kLegRatio = 0.7;    // shorter leg to longer one, at least
constexpr double kMouth = 0.8;       // mouth to shorter leg, at most

enum class Sewn { Together, Apart, Elsewhere };

Sewn how_sewn(const Pattern& pattern, const SeamSide& a, const SeamSide& b) {
  Sewn sewn = Sewn::Apart;
  for (const Seam& seam : pattern.seams) {
    if ((seam.a == a && seam.b == b) || (seam.a == b && seam.b == a)) return Sewn::Together;
    if (seam.a == a || seam.b == a || seam.a == b || seam.b == b) sewn = Sewn::Elsewhere;
  }
  return sewn;
}

bool is_wedge(const Points2& rest, const OutlineEdge& before, const OutlineEdge& in, const OutlineEdge& out,
              const OutlineEdge& after) {
  if (turn_between(rest, in, out) > -kApexTurn * kRadianPerDegree) return false;
  if (std::abs(turn_between(rest, before, after)) > kSideTurn * kRadianPerDegree) return false;
  const Vec2 apex = rest.row(in.vertices.back()), a = rest.row(in.vertices.front()), b = rest.row(out.vertices.back());
  const double shorter = std::min((a - apex).norm(), (b - apex).norm()),
               longer = std::max((a - apex).norm(), (b - apex).norm());
  return shorter >= kLegRatio * longer && (a - b).norm() <= kMouth * shorter;
}

}  // namespace

std::vector<DartWedge> find_dart_wedges(const Pattern& pattern, const PatternMesh& mesh, int panel) {
  std::vector<DartWedge> wedges;
  const std::vector<OutlineEdge> edges = outline_edges(mesh, panel);
  const std::size_t count = edges.size();
  if (count < 5) return wedges;
  for (std::size_t i = 0; i < count; ++i) {
    const OutlineEdge &before = edges[i], &in = edges[(i + 1) % count], &out = edges[(i + 2) % count],
                      &after = edges[(i + 3) % count];
    const Sewn sewn = how_sewn(pattern, {PanelId(panel), in.edge}, {PanelId(panel), out.edge});
    if (sewn == Sewn::Elsewhere || !is_wedge(mesh.rest, before, in, out, after)) continue;
    wedges.push_back({{in.edge, out.edge},
                      {in.vertices, std::vector<int>(out.vertices.rbegin(), out.vertices.rend())},
                      sewn == Sewn::Together});
  }
  return wedges;
}

std::vector<DartWedge> same_wedges(std::vector<DartWedge> wedges, const PatternMesh& mesh, int panel) {
  const std::vector<OutlineEdge> edges = outline_edges(mesh, panel);
  for (DartWedge& wedge : wedges)
    for (const OutlineEdge& edge : edges) {
      if (edge.edge == wedge.edges[0]) wedge.legs[0] = edge.vertices;
      if (edge.edge == wedge.edges[1]) wedge.legs[1].assign(edge.vertices.rbegin(), edge.vertices.rend());
    }
  return wedges;
}

std::vector<std::array<int, 3>> wedge_triangles(const DartWedge& wedge, const Points2& rest) {
  std::vector<std::array<int, 3>> triangles;
  const std::vector<int>&in = wedge.legs[0], &out = wedge.legs[1];
  const auto way = [&](const std::vector<int>& leg, std::size_t i) {
    return (rest.row(leg[i]) - rest.row(leg[0])).norm() / (rest.row(leg.back()) - rest.row(leg[0])).norm();
  };
  std::size_t i = 0, j = 0;
  while (i + 1 < in.size() && j + 1 < out.size()) {  // step on along the leg that lags
    if (i + 2 == in.size() && j + 2 == out.size()) {
      triangles.push_back({in[i], out[j], in.back()});
      break;
    }
    const bool first = j + 2 == out.size() || (i + 2 < in.size() && way(in, i + 1) <= way(out, j + 1));
    triangles.push_back(first ? std::array{in[i], out[j], in[i + 1]} : std::array{in[i], out[j], out[j + 1]});
    ++(first ? i : j);
  }
  return triangles;
}

}  // namespace toile
