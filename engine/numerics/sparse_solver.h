// SPDX-License-Identifier: GPL-3.0-or-later
// Cholesky factorisation of sparse symmetric positive definite matrices (CHOLMOD, one BLAS thread): factor once, solve
// often. The pattern of non-zeros is analysed once and reused by every later factorisation of the same pattern.
#pragma once

#include <memory>

#include <Eigen/Sparse>

#include "engine/core/types.h"

namespace toile {

using SparseMatrix = Eigen::SparseMatrix<double>;  // column major, int indices

class SparseSolver {
 public:
  SparseSolver();
  ~SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  SparseSolver& operator=(SparseSolver&&) noexcept;

  // Factors `matrix`, of which only the lower triangle is read. Returns false if it is not positive definite or holds a
  // value that is not finite; the solver is then unusable until the next successful call.
  [[nodiscard]] bool factor(const SparseMatrix& matrix);

  // Solution of A x = b for every column of `right` (n x k). Requires a successful factor().
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& right) const;
  // The same into memory that is already there; n x k, column major.
  void solve_into(const Eigen::Ref<const Eigen::MatrixXd>& right, Eigen::Ref<Eigen::MatrixXd> solution) const;

  bool factored() const;
  int size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile
