// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/trim_slivers.h"

#include <gtest/gtest.h>

#include "engine/geometry/polygon_boolean.h"

namespace toile {
namespace {

using Loop = std::vector<Vec2>;

TEST(TrimSlivers, TakesOffASpikeAndGivesItBack) {
  Loop outline = {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0.0503, 0.1}, {0.0502, 0.103}, {0.0499, 0.103}, {0.05, 0.1}, {0, 0.1}};
  const double before = signed_area(outline);
  const auto slivers = trim_slivers(outline);
  ASSERT_EQ(slivers.size(), 1u);
  EXPECT_NEAR(signed_area(outline), 0.01, 1e-7);
  EXPECT_NEAR(signed_area(slivers[0]) + signed_area(outline), before, 1e-12);
  for (const Vec2& p : outline) EXPECT_LT(p.y(), 0.1001);
}

TEST(TrimSlivers, LeavesOutlinesWithoutSliversAlone) {
  const Loop strip = {{0, 0}, {0.3, 0}, {0.3, 0.015}, {0.2, 0.0151}, {0.1, 0.015}, {0, 0.015}};
  const Loop dart = {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0.055, 0.1}, {0.05, 0.02}, {0.045, 0.1}, {0, 0.1}};
  for (const Loop& sound : {strip, dart}) {
    Loop outline = sound;
    EXPECT_TRUE(trim_slivers(outline).empty());
    EXPECT_EQ(outline, sound);
  }
}

}  // namespace
}  // namespace toile
