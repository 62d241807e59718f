// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/part_openings.h"

#include <gtest/gtest.h>

#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kRounding = 1e-9;

std::vector<Vec2> wanted() {
  return {Vec2(0, 0), Vec2(0.4, 0), Vec2(0.4, 0.3), Vec2(0, 0.3)};
}

// A strip along the lower edge of `wanted`, 3 cm deep at both ends and `neck` deep in the middle.
std::vector<Vec2> waisted(double neck) {
  return {Vec2(0, 0), Vec2(0.4, 0), Vec2(0.4, 0.03), Vec2(0.2, neck), Vec2(0, 0.03)};
}

TEST(PartedAtNecks, PartsWhereTheClothComesNearTheOutlineAndLeavesNothingBetween) {
  for (const double neck : {0.0, 0.002}) {
    const auto parts = parted_at_necks(waisted(neck), wanted(), {});
    ASSERT_EQ(parts.size(), 2u) << neck;
    for (const auto& part : parts) {
      EXPECT_TRUE(is_simple_polygon(part));
      EXPECT_NEAR(signed_area(part), 0.5 * 0.2 * 0.03, kRounding);  // both end in the outline
    }
  }
}

TEST(PartedAtNecks, LeavesWidePlacesAndTipsAlone) {
  EXPECT_EQ(parted_at_necks(waisted(0.005), wanted(), {}).size(), 1u);
  EXPECT_EQ(parted_at_necks({Vec2(0, 0), Vec2(0.4, 0), Vec2(0, 0.03)}, wanted(), {}).size(), 1u);
}

// Along the bottom 3 cm, up the right side only 8 mm.
std::vector<Vec2> l_shape() {
  return {Vec2(0, 0), Vec2(0.4, 0), Vec2(0.4, 0.2), Vec2(0.392, 0.2), Vec2(0.392, 0.03), Vec2(0, 0.03)};
}

TEST(StripsOf, AnLBecomesTwoStripsUnlessOneWereACrumb) {
  PartOpeningOptions options;
  EXPECT_EQ(strips_of(l_shape(), options).size(), 2u);
  options.least_strip = 0.015;
  EXPECT_EQ(strips_of(l_shape(), options).size(), 1u);
  options.least_strip = 0.0, options.l_shapes = true;
  EXPECT_EQ(strips_of(l_shape(), options).size(), 1u);
}

TEST(RoomiestPoint, IsFoundInALongStripThatRunsAcrossTheGrid) {
  const Vec2 along = Vec2(0.8, 0.3), across = 0.01 * Vec2(-0.3, 0.8).normalized();
  const std::vector<Vec2> strip = {Vec2(0, 0), along, along + across, across};
  EXPECT_NEAR(roomiest_point(strip).clearance, 0.005, 1e-5);
}

}  // namespace
}  // namespace toile
