// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/coarse_pattern.h"

#include <algorithm>
#include <cmath>

#include "engine/alter/panel_outline.h"
#include "engine/core/error.h"
#include "engine/geometry/mesh_polygon.h"

namespace toile {
namespace {

constexpr double kHardlyMore = 1.5;       // times the wanted triangles: not worth a copy
constexpr int kLeastOfPanel = 60;         // triangles
constexpr double kTriangleShape = 0.433;  // area of an equilateral triangle over its edge squared

double length_along(const Points2& rest, const std::vector<int>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (rest.row(line[i]) - rest.row(line[i - 1])).norm();
  return sum;
}

class Coarsener {
 public:
  Coarsener(const Pattern& pattern, const PatternMesh& mesh, const Points2& target, int triangles)
      : pattern_(pattern), mesh_(mesh), target_(target) {
    for (std::size_t p = 0; p < mesh.panels.size(); ++p) areas_.push_back(area_of(static_cast<int>(p)));
    double all = 0.0;
    for (const double area : areas_) all += area;
    for (const double area : areas_)
      edge_lengths_.push_back(std::sqrt(std::min(all / triangles, area / kLeastOfPanel) / kTriangleShape));
    kept_.assign(static_cast<std::size_t>(mesh.vertex_count()), false);
    number_.assign(kept_.size(), -1);
  }

  CoarsePattern run() {
    keep_outline();
    result_.mesh.panel_reversed = mesh_.panel_reversed;
    for (int p = 0; p < static_cast<int>(mesh_.panels.size()); ++p) add_panel(p);
    result_.mesh.rest = to_points(rest_);
    result_.target_rest = to_points(wanted_);
    result_.mesh.triangles.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int k = 0; k < 3; ++k)
        result_.mesh.triangles(static_cast<Eigen::Index>(f), k) = faces_[f][static_cast<std::size_t>(k)];
    add_edges_and_seams();
    return std::move(result_);
  }

 private:
  double area_of(int panel) const {
    const PanelRange& range = mesh_.panels[static_cast<std::size_t>(panel)];
    double sum = 0.0;
    for (int f = range.triangle_begin; f < range.triangle_end; ++f) {
      const Vec2 a = corner(f, 1) - corner(f, 0), b = corner(f, 2) - corner(f, 0);
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
  }
  Vec2 corner(int f, int k) const { return mesh_.rest.row(mesh_.triangles(f, k)); }
  static Points2 to_points(const std::vector<Vec2>& list) {
    Points2 points(static_cast<Eigen::Index>(list.size()), 2);
    for (std::size_t i = 0; i < list.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = list[i].transpose();
    return points;
  }
  bool is_kept(int v) const { return kept_[static_cast<std::size_t>(v)]; }

  void keep_outline();
  void add_panel(int panel);
  Vec2 wanted_at(int panel, const Vec2& point) const;
  void add_edges_and_seams();

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const Points2& target_;
  std::vector<double> areas_, edge_lengths_;
  std::vector<bool> kept_;   // per fine vertex
  std::vector<int> number_;  // per fine vertex: its coarse one, or -1
  std::vector<Vec2> rest_, wanted_;
  std::vector<std::array<int, 3>> faces_;
  CoarsePattern result_;
};

// Every few vertices of each edge, the same ones on both plies of a seam.
void Coarsener::keep_outline() {
  const auto pieces = [](double length, double spacing, std::size_t most) {
    return std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(length / spacing)), 1, most);
  };
  std::vector<std::vector<bool>> sewn(mesh_.edge_vertices.size());
  for (std::size_t p = 0; p < sewn.size(); ++p) sewn[p].assign(mesh_.edge_vertices[p].size(), false);
  for (std::size_t s = 0; s < mesh_.seam_vertices.size(); ++s) {
    const auto& pairs = mesh_.seam_vertices[s];
    if (pairs.empty()) continue;
    double spacing = 1e9, length = 0.0;
    for (const SeamSide& side : {pattern_.seams[s].a, pattern_.seams[s].b}) {
      const auto p = static_cast<std::size_t>(side.panel.value), e = static_cast<std::size_t>(side.edge);
      sewn[p][e] = true;
      spacing = std::min(spacing, edge_lengths_[p]);
      length = std::max(length, length_along(mesh_.rest, mesh_.edge_vertices[p][e]));
      for (const int end : {mesh_.edge_vertices[p][e].front(), mesh_.edge_vertices[p][e].back()})
        kept_[static_cast<std::size_t>(end)] = true;
    }
    const std::size_t last = pairs.size() - 1, count = pieces(length, spacing, std::max<std::size_t>(1, last));
    for (std::size_t k = 0; k <= count; ++k) {
      const auto& [a, b] = pairs[k * last / count];
      kept_[static_cast<std::size_t>(a)] = kept_[static_cast<std::size_t>(b)] = true;
    }
  }
  for (std::size_t p = 0; p < sewn.size(); ++p)
    for (std::size_t e = 0; e < sewn[p].size(); ++e) {
      const std::vector<int>& line = mesh_.edge_vertices[p][e];
      if (sewn[p][e]) continue;
      const std::size_t last = line.size() - 1, count = pieces(length_along(mesh_.rest, line), edge_lengths_[p],
                                                               std::max<std::size_t>(1, last));
      for (std::size_t k = 0; k <= count; ++k) kept_[static_cast<std::size_t>(line[k * last / count])] = true;
    }
}

void Coarsener::add_panel(int panel) {
  const int first = static_cast<int>(rest_.size()), first_face = static_cast<int>(faces_.size());
  std::vector<Vec2> polygon;
  for (const OutlineEdge& edge : outline_edges(mesh_, panel))
    for (std::size_t i = 0; i + 1 < edge.vertices.size(); ++i) {
      const int v = edge.vertices[i];
      if (!is_kept(v)) continue;
      number_[static_cast<std::size_t>(v)] = static_cast<int>(rest_.size());
      polygon.emplace_back(mesh_.rest.row(v));
      rest_.push_back(polygon.back());
      wanted_.emplace_back(target_.row(v));
    }
  const PolygonMesh filled = mesh_polygon(polygon, edge_lengths_[static_cast<std::size_t>(panel)]);
  for (std::size_t i = polygon.size(); i < filled.points.size(); ++i) {
    rest_.push_back(filled.points[i]);
    wanted_.push_back(wanted_at(panel, filled.points[i]));
  }
  for (Eigen::Index f = 0; f < filled.triangles.rows(); ++f)
    faces_.push_back({first + filled.triangles(f, 0), first + filled.triangles(f, 1), first + filled.triangles(f, 2)});
  result_.mesh.panels.push_back({first, static_cast<int>(rest_.size()), first_face, static_cast<int>(faces_.size())});
  result_.mesh.panel_of_vertex.resize(rest_.size(), panel);
  result_.mesh.panel_of_triangle.resize(faces_.size(), panel);
}

// Where the fine mesh takes a point of the panel; past its border, where the nearest face would.
Vec2 Coarsener::wanted_at(int panel, const Vec2& point) const {
  const PanelRange& range = mesh_.panels[static_cast<std::size_t>(panel)];
  double best = -1e9;
  Vec2 wanted = Vec2::Zero();
  for (int f = range.triangle_begin; f < range.triangle_end && best < 0.0; ++f) {
    Mat2 edges;
    edges << corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0);
    const Vec2 share = edges.inverse() * (point - corner(f, 0));
    const double least = std::min({share.x(), share.y(), 1.0 - share.sum()});
    if (least <= best) continue;
    best = least;
    const auto at = [&](int k) { return Vec2(target_.row(mesh_.triangles(f, k))); };
    wanted = (1.0 - share.sum()) * at(0) + share.x() * at(1) + share.y() * at(2);
  }
  return wanted;
}

void Coarsener::add_edges_and_seams() {
  for (const auto& edges : mesh_.edge_vertices) {
    result_.mesh.edge_vertices.emplace_back();
    for (const std::vector<int>& line : edges) {
      std::vector<int> coarse;
      for (const int v : line)
        if (is_kept(v)) coarse.push_back(number_[static_cast<std::size_t>(v)]);
      result_.mesh.edge_vertices.back().push_back(std::move(coarse));
    }
  }
  for (const auto& pairs : mesh_.seam_vertices) {
    result_.mesh.seam_vertices.emplace_back();
    for (const auto& [a, b] : pairs)
      if (is_kept(a) && is_kept(b))
        result_.mesh.seam_vertices.back().emplace_back(number_[static_cast<std::size_t>(a)],
                                                       number_[static_cast<std::size_t>(b)]);
  }
}

}  // namespace

CoarsePattern coarsen(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, int triangles) {
  if (mesh.triangle_count() <= kHardlyMore * triangles) return {mesh, target_rest};
  try {
    return Coarsener(pattern, mesh, target_rest, triangles).run();
  } catch (const Error& error) {
    // An outline that is simple when fine may cross itself when coarse; then the fine mesh serves.
    if (error.code != ErrorCode::GarmentInvalid) throw;
    return {mesh, target_rest};
  }
}

}  // namespace toile
