// SPDX-License-Identifier: GPL-3.0-or-later
// Solves one symmetric positive definite system for three coordinates at once, over and over: the preconditioner of the
// drape. The factor (CHOLMOD, simplicial) is kept in single precision, so the answer is that of a matrix within 1e-6 of
// the given one, still symmetric and positive definite; the arithmetic on the right-hand sides is double. What does not
// depend on each other (subtrees of the elimination tree) is worked off in two halves, which a helper may share: the
// same bytes with and without.
#pragma once

#include <memory>

#include "engine/core/helper.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {

class RowSolver {
 public:
  RowSolver();
  ~RowSolver();
  RowSolver(RowSolver&&) noexcept;
  RowSolver& operator=(RowSolver&&) noexcept;

  // Factors `matrix`, of which only the lower triangle is read; the analysis is kept while the pattern stays the same.
  // False if it is not positive definite or not finite: the solver is then unusable.
  // `held` (ascending): rows whose first coordinate is 0 in every solution, as if the matrix did not have them there.
  [[nodiscard]] bool factor(const SparseMatrix& matrix, const std::vector<int>& held = {});

  // solution = A^-1 right, both #N x 3. Requires a successful factor(). No allocation.
  void solve(const Points3& right, Points3& solution, Helper* helper = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile
