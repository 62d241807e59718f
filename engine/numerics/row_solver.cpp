// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/row_solver.h"

#include <cassert>
#include <cmath>

#include <cholmod.h>

#include "engine/numerics/cholmod_factor.h"

namespace toile {
namespace {

using Row = Eigen::Array<double, 4, 1>;  // three coordinates and one lane of padding

struct Entry {
  std::int32_t row;
  float value;
};

}  // namespace

struct RowSolver::State {
  CholmodFactor cholesky{FactorShape::Simplicial};
  std::vector<std::int32_t> permutation, begin;
  std::vector<Entry> below;  // columns of L below the diagonal, L D L^T
  std::vector<double> inverse_diagonal;
  std::vector<Row> work;

  // Copies the factor into rows that the solve reads from front to back.
  bool copy_factor() {
    const cholmod_factor* factor = cholesky.factor();
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
  return state_->cholesky.compute(matrix) && state_->copy_factor();
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
