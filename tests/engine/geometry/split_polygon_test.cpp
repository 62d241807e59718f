// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/split_polygon.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/geometry/polygon_boolean.h"

namespace toile {
namespace {

constexpr double kAreaRounding = 1e-12;

double total_area(const std::vector<std::vector<Vec2>>& parts) {
  double sum = 0.0;
  for (const auto& part : parts) sum += signed_area(part);
  return sum;
}

TEST(SplitPolygon, LeavesAStripWhole) {
  const std::vector<Vec2> strip = {{0, 0}, {0.08, 0}, {0.08, 0.6}, {0, 0.6}};
  EXPECT_EQ(split_at_reflex_corners(strip), std::vector<std::vector<Vec2>>{strip});
}

TEST(SplitPolygon, MakesTwoStripsOfAnL) {
  const std::vector<Vec2> l = {{0, 0}, {0.4, 0}, {0.4, 0.6}, {0.32, 0.6}, {0.32, 0.05}, {0, 0.05}};
  const auto parts = split_at_reflex_corners(l);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(total_area(parts), signed_area(l), kAreaRounding);
  EXPECT_TRUE(std::all_of(parts.begin(), parts.end(), [](const auto& part) { return is_simple_polygon(part); }));
}

TEST(SplitPolygon, MakesTwoStripsOfAT) {
  const std::vector<Vec2> t = {{0, 0},     {0.05, 0},   {0.05, 0.2}, {0.4, 0.2},
                               {0.4, 0.3}, {0.05, 0.3}, {0.05, 0.6}, {0, 0.6}};
  const auto parts = split_at_reflex_corners(t);
  EXPECT_EQ(parts.size(), 2u);
  EXPECT_NEAR(total_area(parts), signed_area(t), kAreaRounding);
}

TEST(SplitPolygon, LeavesACurvedStripWhole) {
  std::vector<Vec2> arc;
  for (int i = 0; i <= 20; ++i) {
    const double angle = std::numbers::pi * i / 20;
    arc.emplace_back(0.3 * std::cos(angle), 0.3 * std::sin(angle));
  }
  for (int i = 20; i >= 0; --i) {
    const double angle = std::numbers::pi * i / 20;
    arc.emplace_back(0.25 * std::cos(angle), 0.25 * std::sin(angle));
  }
  EXPECT_EQ(split_at_reflex_corners(arc).size(), 1u);
}

}  // namespace
}  // namespace toile
