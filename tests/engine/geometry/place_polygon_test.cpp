// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/place_polygon.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

constexpr double kSearchStep = 1e-3;  // m, as the header promises

std::vector<Vec2> rectangle(double width, double height, const Vec2& at = Vec2::Zero()) {
  return {at, at + Vec2(width, 0), at + Vec2(width, height), at + Vec2(0, height)};
}

// Wide at the bottom, narrow at the top.
std::vector<Vec2> wedge(double size, const Vec2& at = Vec2::Zero()) {
  return {at, at + size * Vec2(1, 0), at + size * Vec2(0.6, 1), at + size * Vec2(0.4, 1)};
}

TEST(PlaceInside, ASmallRectangleComesToLieInTheMiddleOfALargeOne) {
  const auto place = place_inside(rectangle(0.5, 0.6), rectangle(0.3, 0.4, Vec2(2, -1)), false);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->clearance, 0.1, kSearchStep);
  EXPECT_NEAR((*place)(Vec2(2, -1)).x(), 0.1, kSearchStep);
  EXPECT_NEAR((*place)(Vec2(2, -1)).y(), 0.1, kSearchStep);
}

TEST(PlaceInside, APolygonFitsIntoItself) {
  const auto place = place_inside(wedge(0.4), wedge(0.4), false);
  ASSERT_TRUE(place);
  EXPECT_LT(place->shift.norm(), kSearchStep);
}

TEST(PlaceInside, TurnsOnlyWhenAsked) {
  std::vector<Vec2> upside_down;
  for (const Vec2& p : wedge(0.4)) upside_down.push_back(-p);
  EXPECT_FALSE(place_inside(wedge(0.45), upside_down, false));
  const auto place = place_inside(wedge(0.45), upside_down, true);
  ASSERT_TRUE(place);
  EXPECT_TRUE(place->turned);
}

TEST(PlaceInside, NeitherTooLargeNorAcrossANotch) {
  EXPECT_FALSE(place_inside(rectangle(0.5, 0.6), rectangle(0.51, 0.2), false));
  EXPECT_FALSE(place_inside(rectangle(0.5, 0.6), rectangle(0.45, 0.55), false, 0.03));
  const std::vector<Vec2> notched = {Vec2(0, 0),         Vec2(0.5, 0),    Vec2(0.5, 0.3),
                                     Vec2(0.2501, 0.02), Vec2(0.25, 0.3), Vec2(0, 0.3)};
  EXPECT_FALSE(place_inside(notched, rectangle(0.4, 0.2), false));
  EXPECT_TRUE(place_inside(notched, rectangle(0.2, 0.2), false));
}

}  // namespace
}  // namespace toile
