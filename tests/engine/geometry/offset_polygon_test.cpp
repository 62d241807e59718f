// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/offset_polygon.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/geometry/inner_point.h"
#include "engine/geometry/positive_outline.h"

namespace toile {
namespace {

std::vector<double> even(std::size_t count, double distance) {
  return std::vector<double>(count, distance);
}

double distance_to_outline(const std::vector<Vec2>& outline, const Vec2& p) {
  double least = 1e300;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * (b - a) - p).norm());
  }
  return least;
}

const std::vector<Vec2> kSquare = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};

TEST(OffsetPolygon, ASquareGrowsToASquare) {
  const auto grown = offset_polygon(kSquare, even(4, 10));
  ASSERT_EQ(grown.size(), 4u);
  EXPECT_NEAR(polygon_area(grown), 120 * 120, 1e-9);
}

TEST(OffsetPolygon, EachSideKeepsItsOwnDistance) {
  const auto grown = offset_polygon(kSquare, {10, 0, 30, 5});
  ASSERT_EQ(grown.size(), 4u);
  EXPECT_NEAR((grown[0] - Vec2(-5, -10)).norm(), 0, 1e-9);
  EXPECT_NEAR((grown[1] - Vec2(100, -10)).norm(), 0, 1e-9);
  EXPECT_NEAR((grown[2] - Vec2(100, 130)).norm(), 0, 1e-9);
  EXPECT_NEAR((grown[3] - Vec2(-5, 130)).norm(), 0, 1e-9);
}

TEST(OffsetPolygon, AStepInDistanceOnAStraightSideIsAStep) {
  const std::vector<Vec2> split = {{0, 0}, {50, 0}, {100, 0}, {100, 100}, {0, 100}};
  const auto grown = offset_polygon(split, {10, 20, 0, 0, 0});
  EXPECT_NEAR(polygon_area(grown), 100 * 100 + 50 * 10 + 50 * 20, 1e-9);
}

TEST(OffsetPolygon, ASharpTipIsCutSquareAtTheMitreLimit) {
  const std::vector<Vec2> spike = {{0, 0}, {200, 0}, {0, 20}};
  const auto grown = offset_polygon(spike, even(3, 10), 3.0);
  double reach = 0;
  for (const Vec2& p : grown) reach = std::max(reach, p.x());
  EXPECT_GT(reach, 220);
  EXPECT_LE((Vec2(reach, 0) - Vec2(200, 0)).norm(), 31);
  for (const Vec2& p : spike) EXPECT_GE(distance_to_outline(grown, p), 10 - 1e-9);
}

TEST(OffsetPolygon, AHollowCurveTighterThanTheDistanceIsJoined) {
  // A square with a half-circle bay of radius 6 grown by 10: the bay closes.
  std::vector<Vec2> bay = {{0, 0}, {100, 0}, {100, 100}, {56, 100}};
  for (int i = 1; i < 40; ++i) {
    const double angle = std::numbers::pi * i / 40;
    bay.emplace_back(50 + 6 * std::cos(angle), 100 - 6 * std::sin(angle));
  }
  bay.insert(bay.end(), {{44, 100}, {0, 100}});
  const auto grown = offset_polygon(bay, even(bay.size(), 10));
  EXPECT_NEAR(polygon_area(grown), 120 * 120, 1.0);
  for (const Vec2& p : bay) EXPECT_GE(distance_to_outline(grown, p), 10 - 0.01);
}

TEST(OffsetPolygon, AWedgeCutIntoTheOutlineKeepsItsDistance) {
  const std::vector<Vec2> wedge = {{0, 0}, {100, 0}, {100, 100}, {70, 100}, {50, 40}, {30, 100}, {0, 100}};
  const auto grown = offset_polygon(wedge, even(7, 5));
  for (const Vec2& p : grown) EXPECT_GE(distance_to_outline(wedge, p), 5 - 1e-9);
  const auto narrow =
      offset_polygon({{0, 0}, {100, 0}, {100, 100}, {54, 100}, {50, 20}, {46, 100}, {0, 100}}, even(7, 5));
  EXPECT_NEAR(polygon_area(narrow), 110 * 110, 3.0);
}

TEST(OffsetPolygon, ARoundOutlineGrowsByTheDistanceEverywhere) {
  std::vector<Vec2> circle;
  for (int i = 0; i < 200; ++i)
    circle.emplace_back(80 * std::cos(2 * std::numbers::pi * i / 200), 80 * std::sin(2 * std::numbers::pi * i / 200));
  for (const Vec2& p : offset_polygon(circle, even(200, 12))) EXPECT_NEAR(distance_to_outline(circle, p), 12, 0.01);
}

TEST(OffsetPolygon, TinyEdgesBetweenLongOnesDoNotSpike) {
  const std::vector<Vec2> stepped = {{0, 0}, {100, 0}, {100, 50}, {99.5, 50.4}, {99.8, 50.9}, {100, 100}, {0, 100}};
  const auto grown = offset_polygon(stepped, even(7, 10));
  for (const Vec2& p : grown) {
    EXPECT_LE(p.x(), 111);
    EXPECT_GE(distance_to_outline(stepped, p), 10 - 0.01);
  }
  EXPECT_NEAR(polygon_area(grown), 120 * 120, 20);
}

// Jagged stars with hollows narrower than the distance, tiny edges and distances that change from edge to edge.
TEST(OffsetPolygon, EveryRandomOutlineKeepsAtLeastItsDistance) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  for (int round = 0; round < 300; ++round) {
    const int count = 3 + static_cast<int>(random() % 40);
    std::vector<Vec2> star;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * (i + uniform(0, 0.9)) / count;
      star.emplace_back(uniform(30, 200) * Vec2(std::cos(angle), std::sin(angle)));
    }
    std::vector<double> distances;
    for (int i = 0; i < count; ++i) distances.push_back(round % 2 ? 10.0 : std::floor(uniform(0, 4)) * 5);
    const auto grown = offset_polygon(star, distances);
    ASSERT_GT(polygon_area(grown), polygon_area(star) - 1e-6) << round;
    for (std::size_t k = 0; k < star.size(); ++k)
      for (const Vec2& p : {star[k], Vec2(0.5 * (star[k] + star[(k + 1) % star.size()]))}) {
        const double clearance = distance_to_outline(grown, p);
        EXPECT_TRUE(clearance < 1e-6 || inside_polygon(grown, p)) << round;
        // With one distance all round nothing may come nearer than it.
        const double least = round % 2 ? 10 - 0.01 : 0.0;
        EXPECT_GE(clearance, least) << round;
      }
  }
}

TEST(OffsetPolygon, WrongCountsAreRefused) {
  EXPECT_THROW(offset_polygon(kSquare, {1, 2}), Error);
}

TEST(PositiveOutline, ALoopOfTheWrongSenseIsDropped) {
  // A figure of eight: the left lobe runs counter-clockwise, the right one clockwise.
  const std::vector<Vec2> eight = {{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  const auto outline = positive_outline(eight);
  EXPECT_NEAR(polygon_area(outline), 25, 1e-9);
}

}  // namespace
}  // namespace toile
