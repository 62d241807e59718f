// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/integer_program.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace toile {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::vector<bool> bits_of(unsigned mask, std::size_t count) {
  std::vector<bool> bits(count);
  for (std::size_t j = 0; j < count; ++j) bits[j] = (mask >> j) & 1u;
  return bits;
}

// The best value over all 2^n choices; minus infinity when none is feasible.
double best_by_trying_all(const IntegerProgram& program) {
  const std::size_t count = program.weights.size();
  double best = -kInfinite;
  for (unsigned mask = 0; mask < (1u << count); ++mask) {
    const std::vector<bool> bits = bits_of(mask, count);
    if (!is_feasible(program, bits)) continue;
    double value = 0.0;
    for (std::size_t j = 0; j < count; ++j) value += bits[j] ? program.weights[j] : 0.0;
    best = std::max(best, value);
  }
  return best;
}

IntegerProgram random_program(std::mt19937& random) {
  std::uniform_real_distribution<double> weight(-1.0, 3.0);
  std::uniform_int_distribution<int> count(1, 12), coin(0, 2);
  IntegerProgram program;
  program.weights.resize(static_cast<std::size_t>(count(random)));
  for (double& w : program.weights) w = weight(random);
  for (int i = count(random); i > 0; --i) {
    IntegerConstraint row;
    for (int j = 0; j < static_cast<int>(program.weights.size()); ++j)
      if (coin(random) == 0) row.terms.emplace_back(j, coin(random) == 0 ? -1.0 : 1.0);
    const int kind = coin(random);
    row.lower = kind == 0 ? 0.0 : -kInfinite;  // equalities as of sewn pairs, else at most one
    row.upper = kind == 0 ? 0.0 : 1.0;
    program.constraints.push_back(row);
  }
  return program;
}

TEST(IntegerProgram, FindsTheBestOfAllChoicesUpToTwelveVariables) {
  std::mt19937 random(11);
  int with_choice = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const IntegerProgram program = random_program(random);
    const IntegerSolution solution = solve_integer_program(program);
    const double best = best_by_trying_all(program);
    ASSERT_EQ(solution.feasible, best > -kInfinite) << trial;
    if (!solution.feasible) continue;
    EXPECT_TRUE(solution.optimal);
    EXPECT_TRUE(is_feasible(program, solution.chosen));
    EXPECT_NEAR(solution.value, best, 1e-9) << trial;
    with_choice += best > 0.0;
  }
  EXPECT_GT(with_choice, 100);
}

TEST(IntegerProgram, SaysWhenNothingIsFeasible) {
  IntegerProgram program;
  program.weights = {1.0, 1.0};
  program.constraints = {{{{0, 1.0}, {1, 1.0}}, 3.0, kInfinite}};
  EXPECT_FALSE(solve_integer_program(program).feasible);
}

// Twice any number of things is not odd: without the last variable, which costs, every branch looks open to the end.
TEST(IntegerProgram, EndsASearchThatGrowsBeyondMeasure) {
  constexpr int kThings = 40;
  IntegerProgram program;
  IntegerConstraint odd{{}, kThings + 1, kThings + 1};
  for (int i = 0; i < kThings; ++i) {
    program.weights.push_back(0.0);
    odd.terms.emplace_back(i, 2.0);
  }
  program.weights.push_back(-1.0);
  odd.terms.emplace_back(kThings, 1.0);
  program.constraints = {odd};
  const IntegerSolution solution = solve_integer_program(program), again = solve_integer_program(program);
  EXPECT_FALSE(solution.optimal);
  EXPECT_EQ(solution.feasible, !solution.chosen.empty());
  EXPECT_EQ(solution.chosen, again.chosen);
}

TEST(IntegerProgram, RefusesWhatIsNotFiniteOrOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solve_integer_program({{1.0, nan}, {}}), Error);
  EXPECT_THROW(solve_integer_program({{1.0}, {{{{0, nan}}, 0.0, 1.0}}}), Error);
  EXPECT_THROW(solve_integer_program({{1.0}, {{{{0, 1.0}}, nan, 1.0}}}), Error);
  EXPECT_THROW(solve_integer_program({{1.0}, {{{{1, 1.0}}, 0.0, 1.0}}}), Error);
  EXPECT_THROW(solve_integer_program({{1.0}, {{{{0, 1.0}, {0, 1.0}}, 0.0, 1.0}}}), Error);
}

TEST(IntegerProgram, OfNothingIsNothing) {
  const IntegerSolution solution = solve_integer_program({});
  EXPECT_TRUE(solution.feasible);
  EXPECT_TRUE(solution.chosen.empty());
}

}  // namespace
}  // namespace toile
