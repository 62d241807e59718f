// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/sparse_solver.h"

#include <limits>

#include <gtest/gtest.h>

namespace toile {
namespace {

// Second difference on n points plus `shift`: positive definite for shift >= 0.
SparseMatrix chain(int n, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.0 + shift);
    if (i > 0) {
      entries.emplace_back(i, i - 1, -1.0);
      entries.emplace_back(i - 1, i, -1.0);
    }
  }
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(SparseSolver, SolvesSeveralRightSides) {
  const SparseMatrix matrix = chain(50, 0.1);
  const Eigen::MatrixXd wanted = Eigen::MatrixXd::Random(50, 3);
  SparseSolver solver;
  ASSERT_TRUE(solver.factor(matrix));
  EXPECT_LT((solver.solve(matrix * wanted) - wanted).norm(), 1e-12 * wanted.norm());
}

TEST(SparseSolver, RefactorsOtherValuesAndOtherPatterns) {
  SparseSolver solver;
  for (const SparseMatrix& matrix : {chain(20, 0.1), chain(20, 3.0), chain(35, 1.0)}) {
    ASSERT_TRUE(solver.factor(matrix));
    const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(matrix.rows(), -1, 1);
    EXPECT_LT((solver.solve(matrix * wanted) - wanted).norm(), 1e-12);
  }
}

TEST(SparseSolver, RefusesIndefiniteAndNotFiniteMatrices) {
  SparseSolver solver;
  EXPECT_FALSE(solver.factor(chain(10, -3.0)));
  EXPECT_FALSE(solver.factor(chain(10, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(solver.factor(chain(10, 0.0)));
}

}  // namespace
}  // namespace toile
