// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/smooth_sides.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

// Degree of the polynomial a side may move by: enough for the bulge of a hip or a knee, too few for specks of a scan.
constexpr int kLeastDegree = 3, kMostDegree = 7;
constexpr double kLengthPerDegree = 0.4;  // m
constexpr double kRunsOn = 0.09;          // rad, 5 degrees: edges that meet in a lesser turn are one side
constexpr double kNewDirection = 1e-4;    // share of a column that must be new for it to count, against rounding

int degree_for(double length) {
  return std::clamp(kLeastDegree + static_cast<int>(length / kLengthPerDegree), kLeastDegree, kMostDegree);
}

// Columns: Chebyshev polynomials of the arc length, then the side's own coordinates.
Eigen::MatrixXd shapes(const PatternMesh& mesh, const std::vector<int>& vertices) {
  const auto n = static_cast<Eigen::Index>(vertices.size());
  Eigen::VectorXd walked = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i < n; ++i)
    walked[i] = walked[i - 1] + (mesh.rest.row(vertices[static_cast<std::size_t>(i)]) -
                                 mesh.rest.row(vertices[static_cast<std::size_t>(i - 1)]))
                                    .norm();
  const int degree = degree_for(walked[n - 1]);
  Eigen::MatrixXd columns(n, degree + 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = std::acos(std::clamp(2.0 * walked[i] / walked[n - 1] - 1.0, -1.0, 1.0));
    for (int k = 0; k <= degree; ++k) columns(i, k) = std::cos(k * angle);
    columns.row(i).tail<2>() = mesh.rest.row(vertices[static_cast<std::size_t>(i)]);
  }
  return columns;
}

// Orthonormal columns that span the same, by Gram-Schmidt twice.
Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns) {
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < columns.cols() && kept < columns.rows(); ++k) {
    Eigen::VectorXd c = columns.col(k);
    const double before = c.norm();
    for (int twice = 0; twice < 2; ++twice) c -= columns.leftCols(kept) * (columns.leftCols(kept).transpose() * c);
    if (!(c.norm() > kNewDirection * before)) continue;
    columns.col(kept++) = c.normalized();
  }
  return columns.leftCols(kept);
}

// Whether the second of two neighbouring edges runs on where the first one ends.
bool runs_on(const PatternMesh& mesh, const std::vector<int>& in, const std::vector<int>& out) {
  if (in.size() < 2 || out.size() < 2) return false;
  const Vec2 before = mesh.rest.row(in.back()) - mesh.rest.row(in[in.size() - 2]);
  const Vec2 after = mesh.rest.row(out[1]) - mesh.rest.row(out.front());
  return std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after))) < kRunsOn;
}

// The vertices along every side: a run of edges between two corners.
std::vector<std::vector<int>> runs_of(const PatternMesh& mesh, const std::vector<std::vector<int>>& edges) {
  const std::size_t n = edges.size();
  std::size_t first = 0;
  while (first < n && runs_on(mesh, edges[(first + n - 1) % n], edges[first])) ++first;
  std::vector<std::vector<int>> runs;
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<int>& edge = edges[(first + i) % n];
    if (i == 0 || !runs_on(mesh, edges[(first + i - 1) % n], edge))
      runs.push_back(edge);
    else
      runs.back().insert(runs.back().end(), edge.begin() + 1, edge.end());
  }
  return runs;
}

}  // namespace

double SmoothSide::energy(const Points2& rest) const {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(vertices.size()), 2);
  for (std::size_t i = 0; i < vertices.size(); ++i) x.row(static_cast<Eigen::Index>(i)) = rest.row(vertices[i]);
  return (penalty * x).squaredNorm();
}

std::vector<SmoothSide> smooth_sides(const PatternMesh& mesh) {
  std::vector<SmoothSide> sides;
  for (const auto& panel : mesh.edge_vertices)
    for (const std::vector<int>& vertices : runs_of(mesh, panel)) {
      if (vertices.size() < kLeastDegree + 2) continue;
      const Eigen::MatrixXd basis = orthonormal(shapes(mesh, vertices));
      const auto n = static_cast<Eigen::Index>(vertices.size());
      if (basis.cols() >= n) continue;
      sides.push_back({vertices, Eigen::MatrixXd::Identity(n, n) - basis * basis.transpose()});
    }
  return sides;
}

}  // namespace toile
