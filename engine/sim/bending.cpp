// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/bending.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

// Floor of |sin| in a cotangent: a sliver would otherwise stiffen all the cloth around it.
constexpr double kLeastSine = 0.05;

struct RestTriangle {
  Eigen::Vector3i nodes;
  Vec3 cotangent;       // of the angle at each corner
  Vec3 length_squared;  // of the edge opposite each corner
  Eigen::Matrix<double, 2, 3>
      gradient;  // of the hat function of each corner, times twice the area, in the panel's plane
  double area;
  int panel;
};

double cotangent(const Vec2& at, const Vec2& a, const Vec2& b) {
  const Vec2 u = a - at, v = b - at;
  const double product = std::sqrt(u.squaredNorm() * v.squaredNorm());
  return u.dot(v) / std::max(std::abs(u.x() * v.y() - u.y() * v.x()), kLeastSine * product);
}

std::vector<RestTriangle> rest_triangles(const PatternMesh& mesh) {
  std::vector<RestTriangle> triangles;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    RestTriangle t;
    t.nodes = mesh.nodes_of_triangle(f);
    if (t.nodes[0] == t.nodes[1] || t.nodes[1] == t.nodes[2] || t.nodes[2] == t.nodes[0]) continue;
    Vec2 p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh.rest.row(mesh.triangles(f, k));
    for (int k = 0; k < 3; ++k) {
      const Vec2 &next = p[(k + 1) % 3], &last = p[(k + 2) % 3];
      t.cotangent[k] = cotangent(p[k], next, last);
      t.length_squared[k] = (next - last).squaredNorm();
      t.gradient.col(k) = Vec2(next.y() - last.y(), last.x() - next.x());
    }
    const Vec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
    t.area = 0.5 * std::abs(e1.x() * e2.y() - e1.y() * e2.x());
    t.panel = mesh.panel_of_triangle[static_cast<std::size_t>(f)];
    triangles.push_back(t);
  }
  return triangles;
}

// Share of a triangle's area that is nearest to corner k; in an obtuse triangle half goes to the obtuse corner.
double voronoi_area(const RestTriangle& t, int k) {
  int widest = 0;
  const bool obtuse = t.cotangent.minCoeff(&widest) < 0;
  if (obtuse) return widest == k ? 0.5 * t.area : 0.25 * t.area;
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return (t.length_squared[i] * t.cotangent[i] + t.length_squared[j] * t.cotangent[j]) / 8;
}

// Nodes on edges with one triangle or more than two.
std::vector<bool> boundary_nodes(const std::vector<RestTriangle>& triangles, int node_count) {
  std::vector<std::pair<int, int>> edges;
  for (const RestTriangle& t : triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({t.nodes[k], t.nodes[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  std::vector<bool> boundary(static_cast<std::size_t>(node_count), false);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i != 2) {
      boundary[static_cast<std::size_t>(edges[i].first)] = true;
      boundary[static_cast<std::size_t>(edges[i].second)] = true;
    }
    i = end;
  }
  return boundary;
}

void free_turned_over_seams(const Pattern& pattern, const PatternMesh& mesh, std::vector<bool>& free) {
  for (std::size_t s = 0; s < mesh.seam_vertices.size() && s < pattern.seams.size(); ++s)
    if (pattern.seams[s].right_wrong)
      for (const auto& [a, b] : mesh.seam_vertices[s])
        free[static_cast<std::size_t>(mesh.node_of_vertex[static_cast<std::size_t>(a)])] = true;
}

// Area each node answers for: its own, and what its free neighbours, which have no curvature of their own, leave to
// their inner neighbours in equal parts. Without it cloth is softer by half a row of triangles along every edge.
Eigen::VectorXd bent_area(const std::vector<RestTriangle>& triangles, const Eigen::VectorXd& area,
                          const std::vector<bool>& free) {
  const auto is_free = [&](int node) { return free[static_cast<std::size_t>(node)]; };
  Eigen::VectorXd links = Eigen::VectorXd::Zero(area.size()), bent = area;
  for (const RestTriangle& t : triangles)
    for (int k = 0; k < 3; ++k)
      for (int other : {t.nodes[(k + 1) % 3], t.nodes[(k + 2) % 3]})
        if (is_free(t.nodes[k]) && !is_free(other)) links[t.nodes[k]] += 1;
  for (const RestTriangle& t : triangles)
    for (int k = 0; k < 3; ++k)
      for (int other : {t.nodes[(k + 1) % 3], t.nodes[(k + 2) % 3]})
        if (is_free(t.nodes[k]) && !is_free(other)) bent[other] += area[t.nodes[k]] / links[t.nodes[k]];
  return bent;
}

// Nodes all of whose triangles lie in one panel: there both curvatures and the twist can be told apart.
std::vector<bool> inner_nodes(const std::vector<RestTriangle>& triangles, int node_count) {
  constexpr int kNone = -1, kSeveral = -2;
  std::vector<int> panel(static_cast<std::size_t>(node_count), kNone);
  for (const RestTriangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      int& of_node = panel[static_cast<std::size_t>(t.nodes[k])];
      of_node = of_node == kNone || of_node == t.panel ? t.panel : kSeveral;
    }
  std::vector<bool> inner(panel.size());
  for (std::size_t i = 0; i < panel.size(); ++i) inner[i] = panel[i] >= 0;
  return inner;
}

using Entries = std::vector<Eigen::Triplet<double>>;

// Rows 3 i .. 3 i + 2: integrated second derivatives uu, vv and uv at the corners of one triangle.
void add_curvatures(const RestTriangle& t, const std::vector<bool>& free, const std::vector<bool>& inner,
                    Entries& entries) {
  const double longest = t.length_squared.maxCoeff();
  const double divisor = 4 * std::max(t.area, 0.5 * kLeastSine * longest);
  for (int k = 0; k < 3; ++k) {
    const int node = t.nodes[k];
    if (free[static_cast<std::size_t>(node)] || !inner[static_cast<std::size_t>(node)]) continue;
    for (int other = 0; other < 3; ++other) {
      const Vec2 g = t.gradient.col(k), h = t.gradient.col(other);
      entries.emplace_back(3 * node, t.nodes[other], -g.x() * h.x() / divisor);
      entries.emplace_back(3 * node + 1, t.nodes[other], -g.y() * h.y() / divisor);
      entries.emplace_back(3 * node + 2, t.nodes[other], -0.5 * (g.x() * h.y() + g.y() * h.x()) / divisor);
    }
  }
}

// Row 3 i: their sum, where a seam runs through the node.
void add_sums_of_curvatures(const RestTriangle& t, const std::vector<bool>& free, const std::vector<bool>& inner,
                            Entries& entries) {
  for (int k = 0; k < 3; ++k) {
    const int i = t.nodes[(k + 1) % 3], j = t.nodes[(k + 2) % 3];
    const double weight = 0.5 * t.cotangent[k];
    for (const auto& [row, col] : {std::pair(i, j), std::pair(j, i)}) {
      if (free[static_cast<std::size_t>(row)] || inner[static_cast<std::size_t>(row)]) continue;
      entries.emplace_back(3 * row, col, weight);
      entries.emplace_back(3 * row, row, -weight);
    }
  }
}

}  // namespace

SparseMatrix bending_matrix(const Pattern& pattern, const PatternMesh& mesh) {
  const std::vector<RestTriangle> triangles = rest_triangles(mesh);
  std::vector<bool> free = boundary_nodes(triangles, mesh.node_count);
  free_turned_over_seams(pattern, mesh, free);
  const std::vector<bool> inner = inner_nodes(triangles, mesh.node_count);

  Entries entries;
  entries.reserve(triangles.size() * 27);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(mesh.node_count);
  for (const RestTriangle& t : triangles) {
    for (int k = 0; k < 3; ++k) area[t.nodes[k]] += voronoi_area(t, k);
    add_curvatures(t, free, inner, entries);
    add_sums_of_curvatures(t, free, inner, entries);
  }
  SparseMatrix curvature(3 * mesh.node_count, mesh.node_count);
  curvature.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd bent = bent_area(triangles, area, free);
  Eigen::VectorXd scale(3 * mesh.node_count);
  for (int i = 0; i < mesh.node_count; ++i) {
    const double one = area[i] > 0 ? pattern.fabric.bending_stiffness * bent[i] / (area[i] * area[i]) : 0.0;
    scale.segment<3>(3 * i) << one, one, 2 * one;
  }
  SparseMatrix matrix = SparseMatrix(curvature.transpose()) * scale.asDiagonal() * curvature;
  matrix.makeCompressed();
  return matrix;
}

Eigen::VectorXd bending_bound(const SparseMatrix& bending) {
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(bending.cols());
  for (Eigen::Index i = 0; i < bending.outerSize(); ++i)
    for (SparseMatrix::InnerIterator it(bending, i); it; ++it) bound[i] += std::abs(it.value());
  return bound;
}

}  // namespace toile
