// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/closest_features.h"

#include <random>

#include <gtest/gtest.h>

namespace toile {
namespace {

Vec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return {uniform(random), uniform(random), uniform(random)};
}

TEST(ClosestFeatures, NoSampledPairOfPointsIsCloserThanTheAnswer) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_point(random), q = random_point(random), r = random_point(random);
    const Vec3 s = i % 5 == 0 ? Vec3(r + 0.7 * (q - p)) : random_point(random);  // every fifth pair is parallel
    const SegmentPair pair = closest_points_of_segments(p, q, r, s);
    const Vec3 apart = p + pair.s * (q - p) - r - pair.t * (s - r);
    EXPECT_NEAR((apart - pair.apart).norm(), 0, 1e-12);
    for (int a = 0; a <= 20; ++a)
      for (int b = 0; b <= 20; ++b)
        EXPECT_GE((p + a / 20.0 * (q - p) - r - b / 20.0 * (s - r)).norm(), pair.apart.norm() - 1e-9);
  }
}

TEST(ClosestFeatures, SegmentsWithoutLengthArePoints) {
  const Vec3 p(0, 1, 0), r(-1, 0, 0), s(1, 0, 0);
  EXPECT_DOUBLE_EQ(closest_points_of_segments(p, p, r, s).apart.norm(), 1);
  EXPECT_DOUBLE_EQ(closest_points_of_segments(r, s, p, p).apart.norm(), 1);
  EXPECT_DOUBLE_EQ(closest_points_of_segments(p, p, r, r).apart.norm(), std::sqrt(2.0));
}

TEST(ClosestFeatures, PiercingNamesThePointOnBoth) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto through = pierce({0.25, 0.5, 3}, {0.25, 0.5, -1}, a, b, c);
  ASSERT_TRUE(through);
  EXPECT_DOUBLE_EQ(through->s, 0.75);
  EXPECT_NEAR((through->barycentric - Vec3(0.25, 0.25, 0.5)).norm(), 0, 1e-15);
  EXPECT_FALSE(pierce({0.25, 0.5, 3}, {0.25, 0.5, 1}, a, b, c));   // ends above
  EXPECT_FALSE(pierce({0.75, 0.5, 3}, {0.75, 0.5, -1}, a, b, c));  // beside
  EXPECT_FALSE(pierce({0.25, 0.5, 0}, {0.25, 0.5, -1}, a, b, c));  // only touches
}

}  // namespace
}  // namespace toile
