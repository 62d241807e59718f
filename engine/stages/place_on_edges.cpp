// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/place_on_edges.h"

#include "engine/geometry/curve.h"
#include "engine/stages/panel_motion.h"

namespace toile {
namespace {

// Shares of an edge's length walked at its vertices, from 0 to 1.
using Shares = std::vector<double>;

Shares walked_shares(const std::vector<int>& vertices, const Points2& rest) {
  Shares shares = {0.0};
  for (std::size_t i = 1; i < vertices.size(); ++i)
    shares.push_back(shares.back() + (rest.row(vertices[i]) - rest.row(vertices[i - 1])).norm());
  for (double& share : shares)
    if (shares.back() > 0.0) share /= shares.back();
  return shares;
}

void share_evenly(Shares& a, Shares& b, bool same_way) {
  for (std::size_t i = 0; i < a.size() && a.size() == b.size(); ++i) {
    double& other = same_way ? b[i] : b[b.size() - 1 - i];
    const double mean = 0.5 * (a[i] + (same_way ? other : 1.0 - other));
    a[i] = mean;
    other = same_way ? mean : 1.0 - mean;
  }
}

// A vertex that stands for several corners of the drawing, because the edges between them were too short to mesh, keeps
// its place among them.
void place_corners(const Panel& before, const Panel& after, const PatternMesh& mesh, int p, const Points2& rest,
                   Points2& placed) {
  const auto& edges = mesh.edge_vertices[static_cast<std::size_t>(p)];
  const PanelMotion motion(mesh, rest, p);
  std::vector<std::pair<int, Vec2>> found;
  for (int c = 0; c < before.edge_count(); ++c) {
    const int v = edges[static_cast<std::size_t>(c)].front();
    const Vec2 offset = before.edge_start(c) - mesh.rest.row(v).transpose();
    Vec2 place = after.edge_start(c);
    if (offset.norm() > 1e-9) place -= motion.at_vertex(v) * offset;
    found.emplace_back(v, place);
  }
  for (const auto& [vertex, first] : found) {
    Vec2 sum = Vec2::Zero();
    int count = 0;
    for (const auto& [other, place] : found)
      if (other == vertex) sum += place, ++count;
    placed.row(vertex) = (sum / count).transpose();
  }
}

}  // namespace

Points2 place_on_edges(const Pattern& original, const Pattern& drawn, const PatternMesh& mesh, const Points2& rest) {
  std::vector<std::vector<Shares>> shares;
  for (const auto& panel : mesh.edge_vertices) {
    shares.emplace_back();
    for (const auto& edge : panel) shares.back().push_back(walked_shares(edge, rest));
  }
  const auto of = [&](const SeamSide& side) -> Shares& {
    return shares[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)];
  };
  for (const Seam& seam : drawn.seams) share_evenly(of(seam.a), of(seam.b), seam.right_wrong);
  Points2 placed = rest;
  for (std::size_t p = 0; p < shares.size(); ++p) {
    for (std::size_t e = 0; e < shares[p].size(); ++e) {
      const auto& vertices = mesh.edge_vertices[p][e];
      if (vertices.size() < 3) continue;
      const std::vector<Vec2> points = curve_points_at(edge_curve(drawn.panels[p], static_cast<int>(e)), shares[p][e]);
      for (std::size_t i = 1; i + 1 < vertices.size(); ++i) placed.row(vertices[i]) = points[i].transpose();
    }
    place_corners(original.panels[p], drawn.panels[p], mesh, static_cast<int>(p), rest, placed);
  }
  return placed;
}

}  // namespace toile
