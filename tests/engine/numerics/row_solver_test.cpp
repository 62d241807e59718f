// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/row_solver.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

// Laplacian of a grid plus a little on the diagonal, lower triangle.
SparseMatrix grid_matrix(int side, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < side * side; ++i) {
    entries.emplace_back(i, i, 4 + shift);
    if (i % side > 0) entries.emplace_back(i, i - 1, -1);
    if (i >= side) entries.emplace_back(i, i - side, -1);
  }
  SparseMatrix matrix(side * side, side * side);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Points3 ramp(int rows) {
  Points3 points(rows, 3);
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = std::sin(0.7 * static_cast<double>(i) + 1);
  return points;
}

TEST(RowSolver, SolvesThreeCoordinatesToSinglePrecision) {
  const SparseMatrix matrix = grid_matrix(30, 0.1);
  RowSolver solver;
  ASSERT_TRUE(solver.factor(matrix));
  const Points3 expected = ramp(900);
  const Eigen::MatrixXd right = matrix.selfadjointView<Eigen::Lower>() * Eigen::MatrixXd(expected);
  Points3 solution(900, 3);
  solver.solve(right, solution);
  EXPECT_LT((solution - expected).norm(), 1e-5 * expected.norm());
}

// A grid's left half, its middle column held in x: what the whole grid answers to right-hand sides that are the same
// on both sides, but for x, which is opposite.
TEST(RowSolver, HoldsTheFirstCoordinateOfTheMiddleOfASymmetricSystem) {
  constexpr int kSide = 21, kMiddle = kSide / 2, kHalf = kMiddle + 1;
  const SparseMatrix whole = grid_matrix(kSide, 0.1);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> held;
  const auto row_of = [](int i) { return i / kSide * kHalf + std::min(i % kSide, kSide - 1 - i % kSide); };
  for (int j = 0; j < whole.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(whole, j); it; ++it)
      entries.emplace_back(std::max(row_of(it.index()), row_of(j)), std::min(row_of(it.index()), row_of(j)),
                           0.5 * it.value());
  SparseMatrix half(kSide * kHalf, kSide * kHalf);
  half.setFromTriplets(entries.begin(), entries.end());
  for (int r = 0; r < kSide; ++r) held.push_back(r * kHalf + kMiddle);

  Points3 right = ramp(kSide * kSide), half_right = Points3::Zero(kSide * kHalf, 3);
  for (int i = 0; i < kSide * kSide; ++i) {
    const int opposite = i - i % kSide + kSide - 1 - i % kSide;
    if (opposite < i) right.row(i) << -right(opposite, 0), right(opposite, 1), right(opposite, 2);
    if (opposite == i) right(i, 0) = 0;
    half_right.row(row_of(i)) = (opposite == i ? 0.5 : 1.0) * right.row(std::min(i, opposite));
  }
  RowSolver whole_solver, half_solver;
  ASSERT_TRUE(whole_solver.factor(whole));
  ASSERT_TRUE(half_solver.factor(half, held));
  Points3 expected(kSide * kSide, 3), solution(kSide * kHalf, 3);
  whole_solver.solve(right, expected);
  half_solver.solve(half_right, solution);
  for (const int i : held) EXPECT_EQ(solution(i, 0), 0);
  for (int i = 0; i < kSide * kSide; ++i) {
    if (i % kSide > kMiddle) continue;
    EXPECT_LT((solution.row(row_of(i)) - expected.row(i)).norm(), 1e-5 * expected.norm());
  }
}

TEST(RowSolver, IsExactlySymmetric) {
  RowSolver solver;
  ASSERT_TRUE(solver.factor(grid_matrix(12, 0.01)));
  const Points3 a = ramp(144), b = a.reverse();
  Points3 solved_a(144, 3), solved_b(144, 3);
  solver.solve(a, solved_a);
  solver.solve(b, solved_b);
  const double one = b.cwiseProduct(solved_a).sum(), other = a.cwiseProduct(solved_b).sum();
  EXPECT_NEAR(one, other, 1e-12 * std::abs(one));
}

TEST(RowSolver, AnswersTheSameBytesWithAndWithoutAHelper) {
  RowSolver solver;
  ASSERT_TRUE(solver.factor(grid_matrix(30, 0.1)));
  Points3 alone(900, 3), helped(900, 3);
  solver.solve(ramp(900), alone);
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  Helper helper;
  helper.call();
  ASSERT_FALSE(threads.any_idle());
  for (int i = 0; i < 50; ++i) {
    solver.solve(ramp(900), helped, &helper);
    ASSERT_EQ(alone, helped);
  }
}

TEST(RowSolver, RefusesWhatIsNotPositiveDefiniteAndRecovers) {
  RowSolver solver;
  EXPECT_FALSE(solver.factor(grid_matrix(5, -4.5)));
  SparseMatrix broken = grid_matrix(5, 1);
  broken.valuePtr()[3] = std::nan("");
  EXPECT_FALSE(solver.factor(broken));
  EXPECT_TRUE(solver.factor(grid_matrix(5, 1)));
}

}  // namespace
}  // namespace toile
