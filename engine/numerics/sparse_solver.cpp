// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/sparse_solver.h"

#include <cassert>
#include <cmath>
#include <cstring>

#include <cholmod.h>

extern "C" void openblas_set_num_threads(int threads);

namespace toile {
namespace {

// One BLAS thread: sums in another order would change bytes with the number of threads.
void use_one_blas_thread() {
  static const bool done = (openblas_set_num_threads(1), true);
  (void)done;
}

}  // namespace

struct SparseSolver::State {
  cholmod_common common{};
  cholmod_factor* symbolic = nullptr;
  bool numeric = false;
  int n = 0;
  Eigen::VectorXi outer, inner;                                           // the analysed pattern
  mutable cholmod_dense *solution = nullptr, *y = nullptr, *e = nullptr;  // workspace kept between solves

  State() {
    use_one_blas_thread();
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;  // AMD only: the same ordering every time, and METIS is not always there
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
  }
  ~State() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_free_factor(&symbolic, &common);
    cholmod_finish(&common);
  }

  bool same_pattern(const SparseMatrix& m) const {
    return symbolic && outer.size() == m.outerSize() + 1 && inner.size() == m.nonZeros() &&
           std::memcmp(outer.data(), m.outerIndexPtr(), sizeof(int) * static_cast<std::size_t>(outer.size())) == 0 &&
           std::memcmp(inner.data(), m.innerIndexPtr(), sizeof(int) * static_cast<std::size_t>(inner.size())) == 0;
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
  assert(matrix.rows() == matrix.cols() && matrix.isCompressed());
  State& s = *state_;
  s.numeric = false;
  s.n = static_cast<int>(matrix.rows());
  if (!Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return false;

  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;  // symmetric, lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;

  if (!s.same_pattern(matrix)) {
    cholmod_free_factor(&s.symbolic, &s.common);
    s.symbolic = cholmod_analyze(&view, &s.common);
    if (!s.symbolic) return false;
    s.outer = Eigen::Map<const Eigen::VectorXi>(matrix.outerIndexPtr(), matrix.outerSize() + 1);
    s.inner = Eigen::Map<const Eigen::VectorXi>(matrix.innerIndexPtr(), matrix.nonZeros());
  }
  cholmod_factorize(&view, s.symbolic, &s.common);
  s.numeric = s.common.status == CHOLMOD_OK && s.symbolic->minor == s.symbolic->n;
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
  cholmod_solve2(CHOLMOD_A, s.symbolic, &view, nullptr, &s.solution, nullptr, &s.y, &s.e, &s.common);
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
