// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/surface_operators.h"

#include <algorithm>
#include <numeric>

#include "engine/geometry/edge_graph.h"

namespace toile {
namespace {

constexpr double kShrink = 0.5, kInflate = -0.52;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

// Undirected edges with a weight each, summed over their triangles; and how many triangles each has.
struct WeightedEdges {
  std::vector<std::array<int, 2>> ends;
  std::vector<double> weight;
  std::vector<int> triangles;
};

template <class Weight>
WeightedEdges collect_edges(const Triangles& triangles, Weight weight) {
  struct Entry {
    std::uint64_t key;
    double weight;
  };
  std::vector<Entry> entries;
  entries.reserve(at(triangles.rows()) * 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int i = triangles(f, (k + 1) % 3), j = triangles(f, (k + 2) % 3);
      const auto low = static_cast<std::uint64_t>(std::min(i, j)), high = static_cast<std::uint64_t>(std::max(i, j));
      entries.push_back({low << 32 | high, weight(triangles(f, k), i, j)});
    }
  // Stable: the sum of an edge's weights must not depend on how ties are sorted.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  WeightedEdges edges;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].key != entries[i - 1].key) {
      edges.ends.push_back({static_cast<int>(entries[i].key >> 32), static_cast<int>(entries[i].key & 0xffffffffu)});
      edges.weight.push_back(0.0);
      edges.triangles.push_back(0);
    }
    edges.weight.back() += entries[i].weight;
    ++edges.triangles.back();
  }
  return edges;
}

Eigen::SparseMatrix<double> assemble(const WeightedEdges& edges, Eigen::Index count) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(edges.ends.size() * 4);
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const auto [i, j] = edges.ends[e];
    const double w = edges.weight[e];
    entries.emplace_back(i, j, -w), entries.emplace_back(j, i, -w);
    entries.emplace_back(i, i, w), entries.emplace_back(j, j, w);
  }
  Eigen::SparseMatrix<double> laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

}  // namespace

Points3 vertex_normals(const Points3& vertices, const Triangles& triangles) {
  Points3 normals = Points3::Zero(vertices.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Vec3 a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)), c = vertices.row(triangles(f, 2));
    const Vec3 twice_area = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) normals.row(triangles(f, k)) += twice_area.transpose();
  }
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (const double length = normals.row(i).norm(); length > 0) normals.row(i) /= length;
  return normals;
}

Eigen::VectorXd vertex_areas(const Points3& vertices, const Triangles& triangles) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(vertices.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Vec3 a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)), c = vertices.row(triangles(f, 2));
    const double third = (b - a).cross(c - a).norm() / 6.0;
    for (int k = 0; k < 3; ++k) areas[triangles(f, k)] += third;
  }
  return areas;
}

Eigen::SparseMatrix<double> cotangent_laplacian(const Points3& vertices, const Triangles& triangles, double least,
                                                double most) {
  WeightedEdges edges = collect_edges(triangles, [&](int apex, int i, int j) {
    const Vec3 u = vertices.row(i) - vertices.row(apex), v = vertices.row(j) - vertices.row(apex);
    return 0.5 * u.dot(v) / std::max(u.cross(v).norm(), 1e-18);
  });
  for (double& w : edges.weight) w = std::clamp(w, least, most);
  return assemble(edges, vertices.rows());
}

Eigen::SparseMatrix<double> graph_laplacian(const TriangleMesh& mesh) {
  WeightedEdges edges = collect_edges(mesh.triangles, [](int, int, int) { return 1.0; });
  std::fill(edges.weight.begin(), edges.weight.end(), 1.0);
  return assemble(edges, mesh.vertex_count());
}

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double surface_roughness(const TriangleMesh& mesh) {
  const WeightedEdges edges = collect_edges(mesh.triangles, [](int, int, int) { return 1.0; });
  Eigen::VectorXd valence = Eigen::VectorXd::Zero(mesh.vertex_count());
  Points3 bump = Points3::Zero(mesh.vertex_count(), 3), around = bump;
  std::vector<double> lengths;
  for (const auto& [i, j] : edges.ends) {
    const auto d = (mesh.vertices.row(j) - mesh.vertices.row(i)).eval();
    bump.row(i) += d, bump.row(j) -= d;
    valence[i] += 1.0, valence[j] += 1.0;
    lengths.push_back(d.norm());
  }
  for (Eigen::Index i = 0; i < bump.rows(); ++i) bump.row(i) /= std::max(valence[i], 1.0);
  for (const auto& [i, j] : edges.ends) around.row(i) += bump.row(j), around.row(j) += bump.row(i);
  const Points3 normals = vertex_normals(mesh.vertices, mesh.triangles);
  std::vector<double> noise;
  for (Eigen::Index i = 0; i < bump.rows(); ++i)
    if (valence[i] > 0) noise.push_back(std::abs((bump.row(i) - around.row(i) / valence[i]).dot(normals.row(i))));
  return median(std::move(noise)) / std::max(median(std::move(lengths)), 1e-12);
}

Points3 taubin_smooth(const TriangleMesh& mesh, int steps) {
  const WeightedEdges edges = collect_edges(mesh.triangles, [](int, int, int) { return 1.0; });
  Eigen::VectorXd valence = Eigen::VectorXd::Zero(mesh.vertex_count());
  std::vector<bool> open(at(mesh.vertex_count()), false);
  for (std::size_t e = 0; e < edges.ends.size(); ++e)
    for (const int v : edges.ends[e]) {
      valence[v] += 1.0;
      if (edges.triangles[e] == 1) open[at(v)] = true;
    }
  Points3 x = mesh.vertices, sum(x.rows(), 3);
  for (int step = 0; step < 2 * steps; ++step) {
    sum.setZero();
    for (const auto& [i, j] : edges.ends) sum.row(i) += x.row(j), sum.row(j) += x.row(i);
    const double factor = step % 2 == 0 ? kShrink : kInflate;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      if (!open[at(i)] && valence[i] > 0) x.row(i) += factor * (sum.row(i) / valence[i] - x.row(i));
  }
  return x;
}

}  // namespace toile
