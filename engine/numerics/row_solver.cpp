// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/row_solver.h"

#include <cassert>
#include <cmath>
#include <cstring>

#include <cholmod.h>

namespace toile {
namespace {

using Row = Eigen::Array<double, 4, 1>;  // three coordinates and one lane of padding

struct Entry {
  std::int32_t row;
  float value;
};

cholmod_sparse view_of(const SparseMatrix& matrix) {
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
  return view;
}

}  // namespace

struct RowSolver::State {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Eigen::VectorXi outer, inner;  // the analysed pattern
  std::vector<std::int32_t> permutation, begin;
  std::vector<Entry> below;  // columns of L below the diagonal, L D L^T
  std::vector<double> inverse_diagonal;
  std::vector<Row> work;

  State() {
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.supernodal = CHOLMOD_SIMPLICIAL;
  }
  ~State() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  bool same_pattern(const SparseMatrix& m) const {
    return factor && outer.size() == m.outerSize() + 1 && inner.size() == m.nonZeros() &&
           std::memcmp(outer.data(), m.outerIndexPtr(), sizeof(int) * static_cast<std::size_t>(outer.size())) == 0 &&
           std::memcmp(inner.data(), m.innerIndexPtr(), sizeof(int) * static_cast<std::size_t>(inner.size())) == 0;
  }

  // Copies the factor into rows that the solve reads from front to back.
  bool copy_factor() {
    const auto n = static_cast<std::int32_t>(factor->n);
    const auto *p = static_cast<const int*>(factor->p), *i = static_cast<const int*>(factor->i),
               *count = static_cast<const int*>(factor->nz), *order = static_cast<const int*>(factor->Perm);
    const auto* x = static_cast<const double*>(factor->x);
    permutation.assign(order, order + n);
    begin.assign(1, 0);
    below.clear();
    inverse_diagonal.clear();
    for (std::int32_t j = 0; j < n; ++j) {
      if (!(x[p[j]] > 0) || !std::isfinite(x[p[j]])) return false;
      inverse_diagonal.push_back(1 / x[p[j]]);
      for (int k = p[j] + 1; k < p[j] + count[j]; ++k) below.push_back({i[k], static_cast<float>(x[k])});
      begin.push_back(static_cast<std::int32_t>(below.size()));
    }
    work.resize(static_cast<std::size_t>(n));
    return true;
  }
};

RowSolver::RowSolver() : state_(std::make_unique<State>()) {}
RowSolver::~RowSolver() = default;
RowSolver::RowSolver(RowSolver&&) noexcept = default;
RowSolver& RowSolver::operator=(RowSolver&&) noexcept = default;

bool RowSolver::factor(const SparseMatrix& matrix) {
  assert(matrix.rows() == matrix.cols() && matrix.isCompressed());
  State& s = *state_;
  if (!Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return false;
  cholmod_sparse view = view_of(matrix);
  if (!s.same_pattern(matrix)) {
    cholmod_free_factor(&s.factor, &s.common);
    s.factor = cholmod_analyze(&view, &s.common);
    if (!s.factor) return false;
    s.outer = Eigen::Map<const Eigen::VectorXi>(matrix.outerIndexPtr(), matrix.outerSize() + 1);
    s.inner = Eigen::Map<const Eigen::VectorXi>(matrix.innerIndexPtr(), matrix.nonZeros());
  }
  cholmod_factorize(&view, s.factor, &s.common);
  return s.common.status == CHOLMOD_OK && s.factor->minor == s.factor->n && s.copy_factor();
}

void RowSolver::solve(const Points3& right, Points3& solution) {
  State& s = *state_;
  const std::size_t n = s.work.size();
  assert(static_cast<std::size_t>(right.rows()) == n && solution.rows() == right.rows());
  Row* y = s.work.data();
  const Entry* entries = s.below.data();
  for (std::size_t j = 0; j < n; ++j) {
    const double* b = right.data() + 3 * static_cast<std::ptrdiff_t>(s.permutation[j]);
    y[j] << b[0], b[1], b[2], 0;
  }
  for (std::size_t j = 0; j < n; ++j) {
    const Row yj = y[j];
    for (std::int32_t k = s.begin[j]; k < s.begin[j + 1]; ++k)
      y[entries[k].row] -= static_cast<double>(entries[k].value) * yj;
  }
  for (std::size_t j = n; j-- > 0;) {
    Row even = y[j] * s.inverse_diagonal[j], odd = Row::Zero();  // two sums: half the waiting for the last addition
    std::int32_t k = s.begin[j];
    for (; k + 1 < s.begin[j + 1]; k += 2) {
      even -= static_cast<double>(entries[k].value) * y[entries[k].row];
      odd -= static_cast<double>(entries[k + 1].value) * y[entries[k + 1].row];
    }
    if (k < s.begin[j + 1]) even -= static_cast<double>(entries[k].value) * y[entries[k].row];
    y[j] = even + odd;
    double* x = solution.data() + 3 * static_cast<std::ptrdiff_t>(s.permutation[j]);
    x[0] = y[j][0], x[1] = y[j][1], x[2] = y[j][2];
  }
}

}  // namespace toile
