// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/side_by_side.h"

#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace toile {
namespace {

class SideBySide : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(OneThreadAndTwo, SideBySide, testing::Bool());

TEST_P(SideBySide, ReturnsWhatBothReturn) {
  const auto [number, word] = side_by_side(
      GetParam(), [] { return 7; }, [] { return std::string("seven"); });
  EXPECT_EQ(number, 7);
  EXPECT_EQ(word, "seven");
}

TEST_P(SideBySide, ThrowsWhatTheFirstThrowsEvenIfTheSecondThrowsSooner) {
  const auto late = []() -> int {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    throw std::string("first");
  };
  const auto soon = []() -> int { throw std::string("second"); };
  const auto works = [] { return 1; };
  const auto thrown = [&](const auto& first, const auto& second) -> std::string {
    try {
      side_by_side(GetParam(), first, second);
    } catch (const std::string& what) {
      return what;
    }
    return "nothing";
  };
  EXPECT_EQ(thrown(late, soon), "first");
  EXPECT_EQ(thrown(late, works), "first");
  EXPECT_EQ(thrown(works, soon), "second");
}

TEST_P(SideBySide, CountsTheProcessorTimeOfBothForTheCaller) {
  const auto spend = [] {
    const double start = work_cpu_seconds();
    while (work_cpu_seconds() - start < 0.02) continue;
  };
  const double before = work_cpu_seconds();
  side_by_side(GetParam(), spend, spend);
  EXPECT_GE(work_cpu_seconds() - before, 0.04);
}

TEST(SideBySideThreads, RunsTheFirstOnAThreadOfItsOwnOnlyWhenAtOnce) {
  const auto id = [] { return std::this_thread::get_id(); };
  const auto apart = side_by_side(true, id, id), together = side_by_side(false, id, id);
  EXPECT_NE(apart.first, apart.second);
  EXPECT_EQ(together.first, together.second);
}

}  // namespace
}  // namespace toile
