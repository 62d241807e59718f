// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/row_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <cholmod.h>

#include "engine/numerics/block_factor.h"
#include "engine/numerics/cholmod_factor.h"
#include "engine/numerics/tree_halves.h"

namespace toile {

// Rows are numbered by halves: those of the first, those of the second, then the top that both lead to. The second
// half has a copy of the top behind all rows, so that both can add to it at once.
struct RowSolver::State {
  CholmodFactor cholesky{FactorShape::Simplicial};
  TreeHalves halves;
  std::vector<std::int32_t> permutation, column;  // of the matrix and of CHOLMOD's factor, of every row here
  std::vector<BlockFactor::Rows> rows;            // of L, below the diagonal
  BlockFactor lower;
  std::vector<double> inverse_diagonal;
  std::vector<int> held_places;  // ascending; every row that depends on one of them is held
  std::vector<FactorRow> work;

  int row_count() const { return static_cast<int>(permutation.size()); }
  int top_rows() const { return row_count() - halves.second_end; }

  bool copy_factor();
  void lay_out();
  void take_in(const Points3& right, int from, int to);
  void give_back(int from, int to, Points3& solution) const;
  void find_places(const std::vector<int>& held);
  void scale(int from, int to);
};

// Where the entries of the factor go, which only depends on where they are not zero.
void RowSolver::State::lay_out() {
  const cholmod_factor* factor = cholesky.factor();
  const auto n = factor->n;
  const auto *p = static_cast<const int*>(factor->p), *i = static_cast<const int*>(factor->i),
             *count = static_cast<const int*>(factor->nz), *order = static_cast<const int*>(factor->Perm);
  std::vector<int> parent(n, -1);
  for (std::size_t j = 0; j < n; ++j)
    if (count[j] > 1) parent[j] = i[p[j] + 1];
  halves = halve_tree(parent, {count, count + n});
  column.resize(n);
  for (std::size_t j = 0; j < n; ++j) column[static_cast<std::size_t>(halves.place[j])] = static_cast<int>(j);
  permutation.resize(n);
  rows.assign(n, {});
  const int rows_in_all = static_cast<int>(n);
  for (int c = 0; c < rows_in_all; ++c) {
    const int j = column[static_cast<std::size_t>(c)];
    permutation[static_cast<std::size_t>(c)] = order[j];
    const bool second = c >= halves.first_end && c < halves.second_end;
    for (int k = p[j] + 1; k < p[j] + count[j]; ++k) {
      const int row = halves.place[static_cast<std::size_t>(i[k])];
      const bool copied = second && row >= halves.second_end;
      rows[static_cast<std::size_t>(c)].push_back(copied ? row - halves.second_end + rows_in_all : row);
    }
  }
  lower.lay_out(rows, {halves.first_end, halves.second_end, rows_in_all});
  inverse_diagonal.resize(n);
  work.resize(n + static_cast<std::size_t>(top_rows()));
}

// Copies the factor into blocks that the solve reads from front to back.
bool RowSolver::State::copy_factor() {
  lay_out();
  const cholmod_factor* factor = cholesky.factor();
  const auto* p = static_cast<const int*>(factor->p);
  const auto* x = static_cast<const double*>(factor->x);
  for (std::size_t c = 0; c < column.size(); ++c) {
    const double* values = x + p[column[c]];
    if (!(values[0] > 0) || !std::isfinite(values[0])) return false;
    inverse_diagonal[c] = 1 / values[0];
    lower.set_column(static_cast<int>(c), rows[c], values + 1);
  }
  return true;
}

void RowSolver::State::find_places(const std::vector<int>& held) {
  held_places.clear();
  for (int j = 0; j < row_count(); ++j)
    if (std::binary_search(held.begin(), held.end(), permutation[static_cast<std::size_t>(j)]))
      held_places.push_back(j);
}

void RowSolver::State::take_in(const Points3& right, int from, int to) {
  for (auto j = static_cast<std::size_t>(from); j < static_cast<std::size_t>(to); ++j) {
    const double* b = right.data() + 3 * static_cast<std::ptrdiff_t>(permutation[j]);
    work[j] = FactorRow{b[0], b[1], b[2], 0};
  }
}

void RowSolver::State::give_back(int from, int to, Points3& solution) const {
  for (auto j = static_cast<std::size_t>(from); j < static_cast<std::size_t>(to); ++j) {
    double* x = solution.data() + 3 * static_cast<std::ptrdiff_t>(permutation[j]);
    x[0] = work[j][0], x[1] = work[j][1], x[2] = work[j][2];
  }
}

void RowSolver::State::scale(int from, int to) {
  for (auto j = static_cast<std::size_t>(from); j < static_cast<std::size_t>(to); ++j) work[j] *= inverse_diagonal[j];
  for (const int j : held_places)
    if (j >= from && j < to) work[static_cast<std::size_t>(j)][0] = 0;
}

RowSolver::RowSolver() : state_(std::make_unique<State>()) {}
RowSolver::~RowSolver() = default;
RowSolver::RowSolver(RowSolver&&) noexcept = default;
RowSolver& RowSolver::operator=(RowSolver&&) noexcept = default;

bool RowSolver::factor(const SparseMatrix& matrix, const std::vector<int>& held) {
  if (!state_->cholesky.compute(matrix, held) || !state_->copy_factor()) return false;
  state_->find_places(held);
  return true;
}

void RowSolver::solve(const Points3& right, Points3& solution, Helper* helper) {
  State& s = *state_;
  const int n = s.row_count(), first = s.halves.first_end, second = s.halves.second_end;
  assert(right.rows() == n && solution.rows() == n);
  FactorRow* y = s.work.data();
  const auto top = s.work.begin() + second, copied = s.work.begin() + n;
  both(
      helper,
      [&] {
        s.take_in(right, 0, first);
        s.take_in(right, second, n);
        s.lower.forward(0, first, y);
        s.scale(0, first);
      },
      [&] {
        std::fill(copied, s.work.end(), FactorRow{});
        s.take_in(right, first, second);
        s.lower.forward(first, second, y);
        s.scale(first, second);
      });
  for (auto row = top, other = copied; row != copied; ++row, ++other) *row += *other;
  s.lower.forward(second, n, y);
  s.scale(second, n);
  s.lower.backward(second, n, y);
  std::copy(top, copied, copied);
  s.give_back(second, n, solution);
  both(
      helper,
      [&] {
        s.lower.backward(0, first, y);
        s.give_back(0, first, solution);
      },
      [&] {
        s.lower.backward(first, second, y);
        s.give_back(first, second, solution);
      });
}

}  // namespace toile
