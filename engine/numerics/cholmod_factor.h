// SPDX-License-Identifier: GPL-3.0-or-later
// The Cholesky factor both solvers of this room stand on: the matrix is analysed again only when its pattern changes.
// The ordering is always AMD's (CAMD's where some rows are to be last), so that the same matrix has the same factor
// everywhere.
#pragma once

#include <memory>

#include "engine/numerics/sparse_solver.h"

struct cholmod_common_struct;
struct cholmod_factor_struct;

namespace toile {

enum class FactorShape {
  Automatic,   // supernodal where it pays: L L^T
  Simplicial,  // columns one by one: L D L^T
};

class CholmodFactor {
 public:
  explicit CholmodFactor(FactorShape shape);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  // Factors the symmetric matrix whose lower triangle is given, compressed. False where it is not positive definite or
  // not finite. The rows of `last` are eliminated after all others.
  bool compute(const SparseMatrix& matrix, const std::vector<int>& last = {});

  cholmod_common_struct* common() { return common_.get(); }
  cholmod_factor_struct* factor() { return factor_; }

 private:
  bool same_pattern(const SparseMatrix& matrix, const std::vector<int>& last) const;
  void analyse(const SparseMatrix& matrix, const std::vector<int>& last);

  std::unique_ptr<cholmod_common_struct> common_;
  cholmod_factor_struct* factor_ = nullptr;
  Eigen::VectorXi outer_, inner_;  // the analysed pattern
  std::vector<int> last_;
};

}  // namespace toile
