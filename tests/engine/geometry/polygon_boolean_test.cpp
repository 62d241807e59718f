// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/polygon_boolean.h"

#include <limits>

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace toile {
namespace {

constexpr double kSnap = 1e-8;  // of areas: the grid of the coordinates

std::vector<Vec2> box(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

TEST(PolygonBoolean, AreasObeyInclusionAndExclusion) {
  const Loops a = {box(0, 0, 0.4, 0.6)}, b = {box(0.3, 0.2, 0.4, 0.1)};
  const double both = area(polygon_intersection(a, b));
  EXPECT_NEAR(both, 0.01, kSnap);
  EXPECT_NEAR(area(polygon_union({a[0], b[0]})), 0.24 + 0.04 - both, kSnap);
  EXPECT_NEAR(area(polygon_difference(a, b)), 0.24 - both, kSnap);
}

TEST(PolygonBoolean, NeighboursThatShareAnEdgeLeaveNothingBetween) {
  const std::vector<PolygonWithHoles> joined = polygon_union({box(0, 0, 0.1, 0.3), box(0.1, 0, 0.7 / 3, 0.3)});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_TRUE(joined[0].holes.empty());
  EXPECT_TRUE(polygon_difference(joined.front().outline.empty() ? Loops{} : Loops{joined[0].outline},
                                 {box(0, 0, 0.1 + 0.7 / 3, 0.3)})
                  .empty());
}

TEST(PolygonBoolean, TakesLoopsOfEitherOrientationAndKeepsHoles) {
  std::vector<Vec2> clockwise = box(0, 0, 1, 1);
  std::reverse(clockwise.begin(), clockwise.end());
  const std::vector<PolygonWithHoles> ring = polygon_difference({clockwise}, {box(0.25, 0.25, 0.5, 0.5)});
  ASSERT_EQ(ring.size(), 1u);
  ASSERT_EQ(ring[0].holes.size(), 1u);
  EXPECT_GT(signed_area(ring[0].outline), 0.0);
  EXPECT_LT(signed_area(ring[0].holes[0]), 0.0);
  EXPECT_NEAR(area(ring), 0.75, kSnap);
}

TEST(PolygonBoolean, ReadsALoopThatCrossesItselfAsTheAreasItWindsAround) {
  const std::vector<Vec2> bow_tie = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  EXPECT_FALSE(is_simple_polygon(bow_tie));
  EXPECT_TRUE(is_simple_polygon(box(0, 0, 1, 1)));
  EXPECT_NEAR(area(polygon_union({bow_tie})), 0.5, kSnap);
  // A square whose notch has closed over itself: its two legs cross.
  const std::vector<Vec2> closed_dart = {{0, 0}, {0.6, 0}, {0.5, 0.5}, {0.4, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_FALSE(is_simple_polygon(closed_dart));
  EXPECT_NEAR(area(polygon_union({closed_dart})), 1.0, 0.051);
  EXPECT_EQ(polygon_union({closed_dart}).size(), 1u);
}

TEST(PolygonBoolean, IgnoresEmptyLoopsAndRefusesNumbersThatAreNone) {
  EXPECT_TRUE(polygon_union({{}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 1}, {2, 2}}}).empty());
  EXPECT_THROW(polygon_union({{{0, 0}, {1, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}}}), Error);
}

}  // namespace
}  // namespace toile
