// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/inner_point.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace toile {
namespace {

// A strip bent to an arc of 60 degrees lies flush with the chord between its inner ends, which is no edge of it.
TEST(LeastBox, OfABentStripRestsOnTheChordOfItsEnds) {
  constexpr double kInner = 1.0, kOuter = 1.03;
  std::vector<Vec2> strip;
  const auto at = [](double radius, double angle) { return Vec2(radius * std::cos(angle), radius * std::sin(angle)); };
  constexpr double kHalf = std::numbers::pi / 6, kStart = 0.3;  // no edge of it along an axis
  constexpr int kEdges = 7;
  for (int i = 0; i <= kEdges; ++i) strip.push_back(at(kOuter, kStart + 2 * kHalf * i / kEdges));
  for (int i = kEdges; i >= 0; --i) strip.push_back(at(kInner, kStart + 2 * kHalf * i / kEdges));
  const Vec2 box = least_box(strip);
  // An odd number of chords: the middle one is parallel to the chord of the ends.
  EXPECT_NEAR(box.x(), kOuter * std::cos(kHalf / kEdges) - kInner * std::cos(kHalf), 1e-12);
  EXPECT_NEAR(box.y(), 2.0 * kOuter * std::sin(kHalf), 1e-12);
}

TEST(LeastBox, OfLessThanALineIsNothing) {
  EXPECT_EQ(least_box({}), Vec2(0.0, 0.0));
  EXPECT_EQ(least_box({Vec2(3.0, 4.0)}), Vec2(0.0, 0.0));
}

}  // namespace
}  // namespace toile
