// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/block_factor.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace toile {
namespace {

// A random unit lower triangle, in which every `run` neighbouring columns share their rows.
Eigen::MatrixXd lower_triangle(int size, int run, double density, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Eigen::MatrixXd lower = Eigen::MatrixXd::Identity(size, size);
  for (int begin = 0; begin < size; begin += run)
    for (int row = begin + 1; row < size; ++row) {
      if (row >= begin + run && std::abs(number(random)) > density) continue;
      for (int column = begin; column < std::min(row, begin + run); ++column) lower(row, column) = number(random) / 4;
    }
  return lower;
}

struct Laid {
  std::vector<BlockFactor::Rows> rows;
  BlockFactor factor;
};

Laid laid_out(const Eigen::MatrixXd& lower, const std::vector<int>& ends) {
  Laid laid;
  for (int column = 0; column < lower.cols(); ++column) {
    auto& rows = laid.rows.emplace_back();
    for (int row = column + 1; row < lower.rows(); ++row)
      if (lower(row, column) != 0) rows.push_back(row);
  }
  laid.factor.lay_out(laid.rows, ends);
  return laid;
}

void set_values(const Eigen::MatrixXd& lower, Laid& laid) {
  for (int column = 0; column < lower.cols(); ++column) {
    std::vector<double> values;
    for (const int row : laid.rows[static_cast<std::size_t>(column)]) values.push_back(lower(row, column));
    laid.factor.set_column(column, laid.rows[static_cast<std::size_t>(column)], values.data());
  }
}

double difference(const std::vector<FactorRow>& y, const Eigen::VectorXd& expected) {
  double most = 0;
  for (std::size_t i = 0; i < y.size(); ++i)
    most = std::max(most, std::abs(y[i][0] - expected[static_cast<Eigen::Index>(i)]));
  return most;
}

// Columns that share their rows in runs of one to six, thin and full: every width of block, blocks with filled zeros
// and a border between two parts no block reaches over.
TEST(BlockFactor, SubstitutesAsTheDenseTriangleDoes) {
  std::mt19937 random(7);
  for (const int run : {1, 2, 3, 4, 6})
    for (const double density : {0.0, 0.1, 0.6}) {
      const int size = 48, middle = 25;
      const Eigen::MatrixXd lower = lower_triangle(size, run, density, random);
      Laid laid = laid_out(lower, {middle, size});
      set_values(lower, laid);
      const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(size, -1, 2);
      std::vector<FactorRow> y;
      for (const double value : right) y.push_back(FactorRow{value, 0, 0, 0});
      laid.factor.forward(0, middle, y.data());
      laid.factor.forward(middle, size, y.data());
      const Eigen::VectorXd forward = lower.triangularView<Eigen::UnitLower>().solve(right);
      EXPECT_LT(difference(y, forward), 1e-6 * forward.norm()) << "run " << run << ", density " << density;
      for (int i = 0; i < size; ++i) y[static_cast<std::size_t>(i)] = FactorRow{right[i], 0, 0, 0};
      laid.factor.backward(middle, size, y.data());
      laid.factor.backward(0, middle, y.data());
      const Eigen::VectorXd backward = lower.transpose().triangularView<Eigen::UnitUpper>().solve(right);
      EXPECT_LT(difference(y, backward), 1e-6 * backward.norm()) << "run " << run << ", density " << density;
    }
}

TEST(BlockFactor, HasNoValuesBeforeTheyAreSet) {
  std::mt19937 random(8);
  const Eigen::MatrixXd lower = lower_triangle(20, 3, 0.3, random);
  const Laid laid = laid_out(lower, {20});
  std::vector<FactorRow> y(20, FactorRow{1, 2, 3, 0});
  laid.factor.forward(0, 20, y.data());
  for (const FactorRow& row : y) EXPECT_EQ(row[2], 3);
}

}  // namespace
}  // namespace toile
