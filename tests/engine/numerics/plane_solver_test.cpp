// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/plane_solver.h"

#include <cmath>

#include <gtest/gtest.h>

namespace toile {
namespace {

constexpr int kGridSide = 12;

// Laplacian of a grid; its diagonal is added up from the edges.
std::vector<PlaneSolver::Link> grid_links() {
  std::vector<PlaneSolver::Link> links;
  const auto join = [&](int a, int b) {
    const double weight = 1.0 + 0.3 * std::sin(7.0 * a + b);
    links.push_back({a, b, -weight});
    links.push_back({a, a, weight});
    links.push_back({b, b, weight});
  };
  for (int i = 0; i < kGridSide * kGridSide; ++i) {
    if (i % kGridSide > 0) join(i, i - 1);
    if (i >= kGridSide) join(i - kGridSide, i);
  }
  return links;
}

// Every eleventh point slides along a line of its own; all are held a little.
std::vector<Mat2> ties(double firm) {
  std::vector<Mat2> all;
  for (int i = 0; i < kGridSide * kGridSide; ++i) {
    const Vec2 normal(std::cos(i), std::sin(i));
    all.push_back(1e-3 * Mat2::Identity());
    if (i % 11 == 0) all.back() += firm * normal * normal.transpose();
  }
  return all;
}

Eigen::MatrixXd dense(const std::vector<PlaneSolver::Link>& links, const std::vector<Mat2>& ties) {
  const auto n = static_cast<Eigen::Index>(ties.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (const PlaneSolver::Link& link : links)
    for (int k = 0; k < 2; ++k) {
      matrix(2 * link.a + k, 2 * link.b + k) += link.weight;
      if (link.a != link.b) matrix(2 * link.b + k, 2 * link.a + k) += link.weight;
    }
  for (Eigen::Index i = 0; i < n; ++i) matrix.block<2, 2>(2 * i, 2 * i) += ties[static_cast<std::size_t>(i)];
  return matrix;
}

Points2 ramp() {
  Points2 points(kGridSide * kGridSide, 2);
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = std::sin(0.7 * static_cast<double>(i) + 1);
  return points;
}

TEST(PlaneSolver, SolvesWhatADenseSolverSolvesAsOftenAsTheTiesChange) {
  PlaneSolver solver(kGridSide * kGridSide, grid_links());
  const Points2 right = ramp();
  const Eigen::Map<const Eigen::VectorXd> flat(right.data(), right.size());
  for (const double firm : {1.0, 1e3, 0.0}) {
    ASSERT_TRUE(solver.factor(ties(firm)));
    Points2 solution(right.rows(), 2);
    solver.solve(right, solution);
    const Eigen::VectorXd expected = dense(grid_links(), ties(firm)).ldlt().solve(flat);
    const Eigen::Map<const Eigen::VectorXd> found(solution.data(), solution.size());
    EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm()) << firm;
  }
}

TEST(PlaneSolver, RefusesWhatIsNotPositiveDefiniteAndRecovers) {
  PlaneSolver solver(kGridSide * kGridSide, grid_links());
  std::vector<Mat2> pushed = ties(1.0);
  pushed[30] = -10.0 * Mat2::Identity();
  EXPECT_FALSE(solver.factor(pushed));
  pushed[30](0, 0) = std::nan("");
  EXPECT_FALSE(solver.factor(pushed));
  ASSERT_TRUE(solver.factor(ties(1.0)));
  Points2 solution(kGridSide * kGridSide, 2);
  solver.solve(ramp(), solution);
  EXPECT_TRUE(solution.allFinite());
}

TEST(PlaneSolver, TakesPointsWithoutLinks) {
  PlaneSolver solver(2, {});
  ASSERT_TRUE(solver.factor({2.0 * Mat2::Identity(), (Mat2() << 2, 1, 1, 2).finished()}));
  Points2 right(2, 2), solution(2, 2);
  right << 2, 4, 3, 3;
  solver.solve(right, solution);
  EXPECT_NEAR((solution - (Points2(2, 2) << 1, 2, 1, 1).finished()).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace toile
