// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/sparse_solver.h"

#include <cassert>

#include <cholmod.h>

#include "engine/numerics/cholmod_factor.h"

namespace toile {

struct SparseSolver::State {
  CholmodFactor cholesky{FactorShape::Automatic};
  bool numeric = false;
  int n = 0;
  cholmod_dense *solution = nullptr, *y = nullptr, *e = nullptr;  // workspace kept between solves

  ~State() {
    for (cholmod_dense** kept : {&solution, &y, &e}) cholmod_free_dense(kept, cholesky.common());
  }
};

SparseSolver::SparseSolver() : state_(std::make_unique<State>()) {}
SparseSolver::~SparseSolver() = default;
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver& SparseSolver::operator=(SparseSolver&&) noexcept = default;

bool SparseSolver::factored() const {
  return state_->numeric;
}
int SparseSolver::size() const {
  return state_->n;
}

bool SparseSolver::factor(const SparseMatrix& matrix) {
  State& s = *state_;
  s.n = static_cast<int>(matrix.rows());
  s.numeric = s.cholesky.compute(matrix);
  return s.numeric;
}

void SparseSolver::solve_into(const Eigen::Ref<const Eigen::MatrixXd>& right,
                              Eigen::Ref<Eigen::MatrixXd> solution) const {
  State& s = *state_;
  assert(s.numeric && right.rows() == s.n && solution.rows() == s.n && solution.cols() == right.cols());
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(right.rows());
  view.ncol = static_cast<std::size_t>(right.cols());
  view.d = static_cast<std::size_t>(right.outerStride());
  view.nzmax = view.d * view.ncol;
  view.x = const_cast<double*>(right.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, s.cholesky.factor(), &view, nullptr, &s.solution, nullptr, &s.y, &s.e, s.cholesky.common());
  assert(s.solution);
  solution = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(
      static_cast<const double*>(s.solution->x), right.rows(), right.cols(),
      Eigen::OuterStride<>(static_cast<Eigen::Index>(s.solution->d)));
}

Eigen::MatrixXd SparseSolver::solve(const Eigen::Ref<const Eigen::MatrixXd>& right) const {
  Eigen::MatrixXd solution(right.rows(), right.cols());
  solve_into(right, solution);
  return solution;
}

}  // namespace toile
