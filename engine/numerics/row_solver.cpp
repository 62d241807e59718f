// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/row_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <cholmod.h>

#include "engine/numerics/cholmod_factor.h"
#include "engine/numerics/tree_halves.h"

namespace toile {
namespace {

using Row = Eigen::Array<double, 4, 1>;  // three coordinates and one lane of padding

struct Entry {
  std::int32_t row;
  float value;
};

}  // namespace

// Rows are numbered by halves: those of the first, those of the second, then the top that both lead to. The second
// half has a copy of the top behind all rows, so that both can add to it at once.
struct RowSolver::State {
  CholmodFactor cholesky{FactorShape::Simplicial};
  TreeHalves halves;
  std::vector<std::int32_t> permutation, begin;
  std::vector<Entry> below;  // columns of L below the diagonal, L D L^T
  std::vector<double> inverse_diagonal;
  std::vector<Row> work;

  int rows() const { return static_cast<int>(permutation.size()); }
  int top_rows() const { return rows() - halves.second_end; }

  bool copy_factor();
  void take_in(const Points3& right, int from, int to);
  void forward(int from, int to);
  void backward(int from, int to, Points3& solution);
};

// Copies the factor into rows that the solve reads from front to back.
bool RowSolver::State::copy_factor() {
  const cholmod_factor* factor = cholesky.factor();
  const auto n = static_cast<std::int32_t>(factor->n);
  const auto *p = static_cast<const int*>(factor->p), *i = static_cast<const int*>(factor->i),
             *count = static_cast<const int*>(factor->nz), *order = static_cast<const int*>(factor->Perm);
  const auto* x = static_cast<const double*>(factor->x);
  std::vector<int> parent(static_cast<std::size_t>(n), -1), size(static_cast<std::size_t>(n));
  for (std::int32_t j = 0; j < n; ++j) {
    size[static_cast<std::size_t>(j)] = count[j];
    if (count[j] > 1) parent[static_cast<std::size_t>(j)] = *std::min_element(i + p[j] + 1, i + p[j] + count[j]);
  }
  halves = halve_tree(parent, size);
  const std::vector<int>& place = halves.place;
  std::vector<std::int32_t> column(static_cast<std::size_t>(n));
  for (std::int32_t j = 0; j < n; ++j) column[static_cast<std::size_t>(place[static_cast<std::size_t>(j)])] = j;
  permutation.clear();
  begin.assign(1, 0);
  below.clear();
  inverse_diagonal.clear();
  for (std::int32_t c = 0; c < n; ++c) {
    const std::int32_t j = column[static_cast<std::size_t>(c)];
    if (!(x[p[j]] > 0) || !std::isfinite(x[p[j]])) return false;
    permutation.push_back(order[j]);
    inverse_diagonal.push_back(1 / x[p[j]]);
    const bool second = c >= halves.first_end && c < halves.second_end;
    for (int k = p[j] + 1; k < p[j] + count[j]; ++k) {
      const int row = place[static_cast<std::size_t>(i[k])];
      const int copied = second && row >= halves.second_end ? row - halves.second_end + n : row;
      below.push_back({copied, static_cast<float>(x[k])});
    }
    begin.push_back(static_cast<std::int32_t>(below.size()));
  }
  work.resize(static_cast<std::size_t>(n + top_rows()));
  return true;
}

void RowSolver::State::take_in(const Points3& right, int from, int to) {
  for (auto j = static_cast<std::size_t>(from); j < static_cast<std::size_t>(to); ++j) {
    const double* b = right.data() + 3 * static_cast<std::ptrdiff_t>(permutation[j]);
    work[j] << b[0], b[1], b[2], 0;
  }
}

void RowSolver::State::forward(int from, int to) {
  Row* y = work.data();
  const Entry* entries = below.data();
  for (auto j = static_cast<std::size_t>(from); j < static_cast<std::size_t>(to); ++j) {
    const Row yj = y[j];
    for (std::int32_t k = begin[j]; k < begin[j + 1]; ++k)
      y[entries[k].row] -= static_cast<double>(entries[k].value) * yj;
  }
}

void RowSolver::State::backward(int from, int to, Points3& solution) {
  Row* y = work.data();
  const Entry* entries = below.data();
  for (auto j = static_cast<std::size_t>(to); j-- > static_cast<std::size_t>(from);) {
    Row even = y[j] * inverse_diagonal[j], odd = Row::Zero();  // two sums: half the waiting for the last addition
    std::int32_t k = begin[j];
    for (; k + 1 < begin[j + 1]; k += 2) {
      even -= static_cast<double>(entries[k].value) * y[entries[k].row];
      odd -= static_cast<double>(entries[k + 1].value) * y[entries[k + 1].row];
    }
    if (k < begin[j + 1]) even -= static_cast<double>(entries[k].value) * y[entries[k].row];
    y[j] = even + odd;
    double* x = solution.data() + 3 * static_cast<std::ptrdiff_t>(permutation[j]);
    x[0] = y[j][0], x[1] = y[j][1], x[2] = y[j][2];
  }
}

RowSolver::RowSolver() : state_(std::make_unique<State>()) {}
RowSolver::~RowSolver() = default;
RowSolver::RowSolver(RowSolver&&) noexcept = default;
RowSolver& RowSolver::operator=(RowSolver&&) noexcept = default;

bool RowSolver::factor(const SparseMatrix& matrix) {
  return state_->cholesky.compute(matrix) && state_->copy_factor();
}

void RowSolver::solve(const Points3& right, Points3& solution, Helper* helper) {
  State& s = *state_;
  const int n = s.rows(), first = s.halves.first_end, second = s.halves.second_end;
  assert(right.rows() == n && solution.rows() == n);
  const auto top = s.work.begin() + second, copied = s.work.begin() + n;
  both(
      helper,
      [&] {
        s.take_in(right, 0, first);
        s.take_in(right, second, n);
        s.forward(0, first);
      },
      [&] {
        std::fill(copied, s.work.end(), Row::Zero());
        s.take_in(right, first, second);
        s.forward(first, second);
      });
  std::transform(top, copied, copied, top, [](const Row& a, const Row& b) -> Row { return a + b; });
  s.forward(second, n);
  s.backward(second, n, solution);
  std::copy(top, copied, copied);
  both(
      helper, [&] { s.backward(0, first, solution); }, [&] { s.backward(first, second, solution); });
}

}  // namespace toile
