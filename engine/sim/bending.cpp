// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/bending.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace toile {
namespace {

// Floor of |sin| in a cotangent: a sliver would otherwise make one hinge stiffer than all the cloth around it.
constexpr double kLeastSine = 0.05;

struct HalfHinge {
  std::pair<int, int> edge;  // nodes, ascending
  int opposite;              // node
  double cot_low, cot_high;  // cotangents of the angles at edge.first and edge.second
  double area;
};

double cotangent(const Vec2& at, const Vec2& a, const Vec2& b) {
  const Vec2 u = a - at, v = b - at;
  const double product = std::sqrt(u.squaredNorm() * v.squaredNorm());
  return u.dot(v) / std::max(std::abs(u.x() * v.y() - u.y() * v.x()), kLeastSine * product);
}

std::set<std::pair<int, int>> turned_over_edges(const Pattern& pattern, const PatternMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (std::size_t s = 0; s < mesh.seam_vertices.size() && s < pattern.seams.size(); ++s) {
    if (!pattern.seams[s].right_wrong) continue;
    const auto& pairs = mesh.seam_vertices[s];
    for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
      const int a = mesh.node_of_vertex[static_cast<std::size_t>(pairs[i].first)];
      const int b = mesh.node_of_vertex[static_cast<std::size_t>(pairs[i + 1].first)];
      edges.insert(std::minmax(a, b));
    }
  }
  return edges;
}

std::vector<HalfHinge> half_hinges(const PatternMesh& mesh) {
  std::vector<HalfHinge> halves;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) continue;
    const Vec2 p[3] = {mesh.rest.row(mesh.triangles(f, 0)), mesh.rest.row(mesh.triangles(f, 1)),
                       mesh.rest.row(mesh.triangles(f, 2))};
    const Vec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const double area = 0.5 * std::abs(e1.x() * e2.y() - e1.y() * e2.x());
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double at_i = cotangent(p[i], p[j], p[k]), at_j = cotangent(p[j], p[k], p[i]);
      const bool ascending = n[i] < n[j];
      halves.push_back({std::minmax(n[i], n[j]), n[k], ascending ? at_i : at_j, ascending ? at_j : at_i, area});
    }
  }
  std::stable_sort(halves.begin(), halves.end(),
                   [](const HalfHinge& a, const HalfHinge& b) { return a.edge < b.edge; });
  return halves;
}

void add_hinge(const HalfHinge& l, const HalfHinge& r, double stiffness, std::vector<Eigen::Triplet<double>>& entries) {
  const int node[4] = {l.edge.first, l.edge.second, l.opposite, r.opposite};
  const double k[4] = {l.cot_high + r.cot_high, l.cot_low + r.cot_low, -l.cot_low - l.cot_high,
                       -r.cot_low - r.cot_high};
  const double scale = stiffness * 3 / (l.area + r.area);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) entries.emplace_back(node[i], node[j], scale * k[i] * k[j]);
}

}  // namespace

SparseMatrix bending_matrix(const Pattern& pattern, const PatternMesh& mesh) {
  const auto turned_over = turned_over_edges(pattern, mesh);
  const std::vector<HalfHinge> halves = half_hinges(mesh);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(halves.size() * 8);
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t end = i + 1;
    while (end < halves.size() && halves[end].edge == halves[i].edge) ++end;
    const bool hinge = end - i == 2 && halves[i].opposite != halves[i + 1].opposite;
    if (hinge && !turned_over.contains(halves[i].edge))
      add_hinge(halves[i], halves[i + 1], pattern.fabric.bending_stiffness, entries);
    i = end;
  }
  SparseMatrix matrix(mesh.node_count, mesh.node_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace toile
