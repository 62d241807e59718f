// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/fair_vertices.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {

namespace {

// Cotangents beyond these come from triangles too thin to say anything about the shape.
constexpr double kLeastWeight = 1e-3, kMostWeight = 10.0;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double cotangent_at(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double sine = (a - p).cross(b - p).norm();
  return sine > 0 ? (a - p).dot(b - p) / sine : kMostWeight;
}

// The part of the surface that the energy sees: moving vertices, and two rings around them that only give values.
class Fairing {
 public:
  Fairing(TriangleMesh& mesh, const std::vector<int>& moving) : mesh_(mesh), moving_(moving) {
    unknown_.assign(at(mesh.vertex_count()), -1);
    for (std::size_t i = 0; i < moving.size(); ++i) unknown_[at(moving[i])] = static_cast<int>(i);
    find_rows();
  }

  void solve(bool equal_weights) {
    const std::vector<double> areas = row_areas();
    std::vector<Eigen::Triplet<double>> to_moving;
    Eigen::MatrixXd fixed = Eigen::MatrixXd::Zero(row_count_, 3);
    std::vector<double> row_sum(at(row_count_), 0.0);
    for (const int f : triangles_)
      for (int k = 0; k < 3; ++k) {
        const int i = mesh_.triangles(f, k), j = mesh_.triangles(f, (k + 1) % 3), o = mesh_.triangles(f, (k + 2) % 3);
        const double w = equal_weights ? 0.5
                                       : std::clamp(0.5 * cotangent_at(position(o), position(i), position(j)),
                                                    kLeastWeight, kMostWeight);
        add_weight(i, j, w, to_moving, fixed, row_sum);
        add_weight(j, i, w, to_moving, fixed, row_sum);
      }
    for (int v = 0; v < mesh_.vertex_count(); ++v)
      if (row_[at(v)] >= 0) add_entry(row_[at(v)], v, row_sum[at(row_[at(v)])], to_moving, fixed);
    SparseMatrix laplacian(row_count_, static_cast<int>(moving_.size()));
    laplacian.setFromTriplets(to_moving.begin(), to_moving.end());
    Eigen::VectorXd inverse_area(row_count_);
    for (int r = 0; r < row_count_; ++r) inverse_area[r] = equal_weights ? 1.0 : 1.0 / areas[at(r)];
    const SparseMatrix normal = laplacian.transpose() * inverse_area.asDiagonal() * laplacian;
    SparseSolver solver;
    if (!solver.factor(normal)) throw Error(ErrorCode::Internal, "mesh", "a part to be faired touches nothing fixed");
    const Eigen::MatrixXd x = solver.solve(-(laplacian.transpose() * inverse_area.asDiagonal() * fixed));
    for (std::size_t i = 0; i < moving_.size(); ++i) mesh_.vertices.row(moving_[i]) = x.row(static_cast<int>(i));
  }

 private:
  Vec3 position(int v) const { return mesh_.vertices.row(v).transpose(); }

  // Rows of the Laplacian: moving vertices and their neighbours; triangles: all around those.
  void find_rows() {
    std::vector<bool> in_row(at(mesh_.vertex_count()), false);
    for (int f = 0; f < mesh_.triangle_count(); ++f) {
      const auto t = mesh_.triangles.row(f);
      if (unknown_[at(t[0])] < 0 && unknown_[at(t[1])] < 0 && unknown_[at(t[2])] < 0) continue;
      for (int k = 0; k < 3; ++k) in_row[at(t[k])] = true;
    }
    row_.assign(at(mesh_.vertex_count()), -1);
    for (int v = 0; v < mesh_.vertex_count(); ++v)
      if (in_row[at(v)]) row_[at(v)] = row_count_++;
    for (int f = 0; f < mesh_.triangle_count(); ++f) {
      const auto t = mesh_.triangles.row(f);
      if (in_row[at(t[0])] || in_row[at(t[1])] || in_row[at(t[2])]) triangles_.push_back(f);
    }
  }

  std::vector<double> row_areas() const {
    std::vector<double> areas(at(row_count_), 0.0);
    double total = 0.0;
    for (const int f : triangles_) {
      const Vec3 a = position(mesh_.triangles(f, 0));
      const double area = (position(mesh_.triangles(f, 1)) - a).cross(position(mesh_.triangles(f, 2)) - a).norm() / 2.0;
      total += area;
      for (int k = 0; k < 3; ++k)
        if (row_[at(mesh_.triangles(f, k))] >= 0) areas[at(row_[at(mesh_.triangles(f, k))])] += area / 3.0;
    }
    // A vertex in the middle of slivers must not weigh without bound.
    const double least = 1e-3 * total / static_cast<double>(triangles_.size());
    for (double& area : areas) area = std::max(area, least);
    return areas;
  }

  void add_entry(int row, int vertex, double value, std::vector<Eigen::Triplet<double>>& to_moving,
                 Eigen::MatrixXd& fixed) const {
    if (unknown_[at(vertex)] >= 0)
      to_moving.emplace_back(row, unknown_[at(vertex)], value);
    else
      fixed.row(row) += value * mesh_.vertices.row(vertex);
  }

  void add_weight(int i, int j, double w, std::vector<Eigen::Triplet<double>>& to_moving, Eigen::MatrixXd& fixed,
                  std::vector<double>& row_sum) const {
    const int row = row_[at(i)];
    if (row < 0) return;
    add_entry(row, j, -w, to_moving, fixed);
    row_sum[at(row)] += w;
  }

  TriangleMesh& mesh_;
  const std::vector<int>& moving_;
  std::vector<int> unknown_;  // vertex -> column, -1 when it stays
  std::vector<int> row_;      // vertex -> row of the Laplacian, -1 outside
  int row_count_ = 0;
  std::vector<int> triangles_;
};

}  // namespace

void fair_vertices(TriangleMesh& mesh, const std::vector<int>& moving) {
  if (moving.empty()) return;
  Fairing fairing(mesh, moving);
  fairing.solve(true);
  fairing.solve(false);
}

}  // namespace toile
