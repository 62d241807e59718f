// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/split_mesh.h"

#include <algorithm>
#include <map>

#include "engine/geometry/disjoint_sets.h"

namespace toile::bench {
namespace {

class Splitter {
 public:
  explicit Splitter(const PatternMesh& coarse) : coarse_(coarse) {}

  PatternMesh run() {
    PatternMesh& fine = result_;
    fine.panel_reversed = coarse_.panel_reversed;
    fine.target_edge_length = 0.5 * coarse_.target_edge_length;
    fine.triangles.resize(4 * coarse_.triangles.rows(), 3);
    number_.resize(static_cast<std::size_t>(coarse_.vertex_count()));
    for (std::size_t p = 0; p < coarse_.panels.size(); ++p) split_panel(p);
    fine.rest.resize(static_cast<Eigen::Index>(rest_.size()), 2);
    for (std::size_t v = 0; v < rest_.size(); ++v) fine.rest.row(static_cast<Eigen::Index>(v)) = rest_[v].transpose();
    sew();
    return std::move(result_);
  }

 private:
  // Old vertices first, then the middles of edges in the order in which triangles come upon them.
  void split_panel(std::size_t p) {
    const PanelRange& range = coarse_.panels[p];
    const int first = static_cast<int>(rest_.size());
    for (int v = range.vertex_begin; v < range.vertex_end; ++v) {
      number_[static_cast<std::size_t>(v)] = static_cast<int>(rest_.size());
      add_vertex(v, v);
    }
    for (int f = range.triangle_begin; f < range.triangle_end; ++f) split_triangle(f);
    const int vertices = static_cast<int>(rest_.size());
    result_.panels.push_back({first, vertices, 4 * range.triangle_begin, 4 * range.triangle_end});
    result_.panel_of_vertex.resize(static_cast<std::size_t>(vertices), static_cast<int>(p));
    result_.panel_of_triangle.resize(4 * static_cast<std::size_t>(range.triangle_end), static_cast<int>(p));
    result_.edge_vertices.emplace_back();
    for (const std::vector<int>& edge : coarse_.edge_vertices[p])
      result_.edge_vertices.back().push_back(with_middles(edge));
  }

  void split_triangle(int f) {
    int corner[3], middle[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = number_[static_cast<std::size_t>(coarse_.triangles(f, k))];
      middle[k] = middle_of(coarse_.triangles(f, k), coarse_.triangles(f, (k + 1) % 3));
    }
    Triangles& fine = result_.triangles;
    for (int k = 0; k < 3; ++k) fine.row(4 * f + k) << corner[k], middle[k], middle[(k + 2) % 3];
    fine.row(4 * f + 3) << middle[0], middle[1], middle[2];
  }

  int middle_of(int a, int b) {
    const auto [at, is_new] = middle_.try_emplace(std::minmax({a, b}), static_cast<int>(rest_.size()));
    if (is_new) add_vertex(a, b);
    return at->second;
  }

  void add_vertex(int a, int b) { rest_.push_back(0.5 * (coarse_.rest.row(a) + coarse_.rest.row(b)).transpose()); }

  std::vector<int> with_middles(const std::vector<int>& edge) const {
    std::vector<int> all;
    for (std::size_t k = 0; k < edge.size(); ++k) {
      if (k > 0) all.push_back(middle_.at(std::minmax({edge[k - 1], edge[k]})));
      all.push_back(number_[static_cast<std::size_t>(edge[k])]);
    }
    return all;
  }

  // Kept nodes meet as before, middles where a seam runs through both.
  void sew() {
    PatternMesh& fine = result_;
    DisjointSets sewn(static_cast<int>(rest_.size()));
    for (const auto& pairs : coarse_.seam_vertices) {
      auto& split = fine.seam_vertices.emplace_back();
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (k > 0)
          split.emplace_back(middle_.at(std::minmax({pairs[k - 1].first, pairs[k].first})),
                             middle_.at(std::minmax({pairs[k - 1].second, pairs[k].second})));
        split.emplace_back(number_[static_cast<std::size_t>(pairs[k].first)],
                           number_[static_cast<std::size_t>(pairs[k].second)]);
      }
      for (const auto& [a, b] : split) sewn.join(a, b);
    }
    std::tie(fine.node_of_vertex, fine.node_count) = sewn.numbering();
  }

  const PatternMesh& coarse_;
  PatternMesh result_;
  std::vector<Vec2> rest_;
  std::vector<int> number_;  // new, per old vertex
  std::map<std::pair<int, int>, int> middle_;
};

}  // namespace

PatternMesh split_mesh(const PatternMesh& coarse) {
  return Splitter(coarse).run();
}

}  // namespace toile::bench
