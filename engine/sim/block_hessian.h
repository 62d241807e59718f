// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives of an energy over the garment's nodes: a symmetric matrix of 3 x 3 blocks, N/m, of which the
// blocks on and below the diagonal are kept. The blocks of the cloth's own triangles and hinges stand from the start,
// so that its pattern, and with it the analysis of a factorisation, stays the same; others (cloth against cloth) are
// added as they come.
#pragma once

#include <map>
#include <vector>

#include "engine/core/types.h"
#include "engine/numerics/sparse_solver.h"
#include "engine/sim/cloth.h"

namespace toile {

class BlockHessian {
 public:
  explicit BlockHessian(const Cloth& cloth);

  void set_zero();
  // Adds the derivative of the gradient at node i by node j, and its transpose at (j, i). Give every pair of different
  // nodes once, a diagonal block whole.
  void add(int i, int j, const Mat3& block);

  int node_count() const { return static_cast<int>(begin_.size()) - 1; }
  // 3 #N x 3 #N, coordinates of a node beside each other, lower triangle.
  SparseMatrix lower_triangle() const;
  // The product with #N x 3 directions.
  Points3 times(const Points3& directions) const;

 private:
  std::vector<int> begin_, row_;  // blocks of a column j: rows row_[begin_[j] .. begin_[j + 1]), ascending, first j
  std::vector<Mat3> block_;       // at (row, j)
  std::map<std::pair<int, int>, Mat3> further_;  // (column, row), outside that pattern
};

// The nearest positive semidefinite matrix: eigenvalues below zero become zero.
template <int N>
Eigen::Matrix<double, N, N> without_negative_curvature(const Eigen::Matrix<double, N, N>& matrix) {
  if (Eigen::LLT<Eigen::Matrix<double, N, N>>(matrix).info() == Eigen::Success) return matrix;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace toile
