// SPDX-License-Identifier: GPL-3.0-or-later
// Cases 7-14 of the method: alterations whose areas are known exactly (in square centimetres here).
#include "engine/alter/alter_pattern.h"

#include <gtest/gtest.h>

#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using test::grid_garment;
using test::GridGarment;
using Map = std::function<Vec2(int panel, const Vec2&)>;

constexpr double kPerCm2 = 1e4;

GridGarment sheet(double spacing = 0.02, double jitter = 0.2) {
  return grid_garment({{"front", 0.4, 0.6, static_cast<int>(0.4 / spacing), static_cast<int>(0.6 / spacing), jitter}});
}

struct Areas {
  double inserted, removed;
};

AlterPatternResult alter(const GridGarment& garment, const Map& map, const AlterPatternOptions& options = {}) {
  return alter_pattern(garment.pattern, garment.mesh, garment.mapped(map), options);
}

void expect_areas(const AlterPatternResult& result, const Areas& wanted, double tolerance) {
  EXPECT_NEAR(result.inserted_area * kPerCm2, wanted.inserted, tolerance);
  EXPECT_NEAR(result.removed_area * kPerCm2, wanted.removed, tolerance);
  EXPECT_LT(result.area_imbalance, 0.01);
  EXPECT_TRUE(result.flags.empty()) << result.flags.front();
}

Map scaled(double wide, double tall) {
  return [=](int, const Vec2& p) { return Vec2(wide * p.x(), tall * p.y()); };
}

TEST(AlterPattern, DoesNothingWhenTheTargetIsTheReference) {
  const AlterPatternResult result = alter(sheet(), scaled(1, 1));
  expect_areas(result, {0, 0}, 0.0);
  EXPECT_EQ(result.trials, 0);
}

TEST(AlterPattern, Case7InsertsAStrip) {
  for (const double spacing : {0.04, 0.02}) expect_areas(alter(sheet(spacing), scaled(1.2, 1)), {480, 0}, 1);
}

TEST(AlterPattern, Case7ReversedTakesAStripAway) {
  const GridGarment wide = grid_garment({{"front", 0.48, 0.6, 24, 30, 0.2}});
  expect_areas(alter(wide, scaled(1 / 1.2, 1)), {0, 480}, 1);
}

TEST(AlterPattern, Case8InsertsAndRemovesAtOnce) {
  expect_areas(alter(sheet(), scaled(1.2, 50.0 / 60)), {400, 400}, 1);
}

TEST(AlterPattern, Case9WidensAndLengthens) {
  expect_areas(alter(sheet(), scaled(1.2, 1.2)), {1056, 0}, 1);
}

TEST(AlterPattern, Case10LetsOneWedgeIn) {
  const auto flare = [](int, const Vec2& p) { return Vec2(p.x() * (0.52 - 0.12 * p.y() / 0.6) / 0.4, p.y()); };
  const AlterPatternResult result = alter(sheet(), flare);
  expect_areas(result, {360, 0}, 2);
  EXPECT_EQ(result.panels[0].insertions.size(), 1u);
}

TEST(AlterPattern, Case11FindsADart) {
  const auto dart = [](int, const Vec2& p) {
    const double narrow = 0.04 * std::max(0.0, (p.y() - 0.35) / 0.25);
    return Vec2(narrow + p.x() * (0.4 - 2 * narrow) / 0.4, p.y());
  };
  const AlterPatternResult result = alter(sheet(), dart);
  expect_areas(result, {0, 100}, 2);
}

TEST(AlterPattern, Case13OpensBothPliesOfASeam) {
  const GridGarment two =
      grid_garment({{"left", 0.4, 0.6, 20, 30, 0.2}, {"right", 0.4, 0.6, 20, 30, 0.2}}, {{0, 1, 1, 3}});
  const AlterPatternResult result = alter(two, scaled(1, 1.2));
  expect_areas(result, {960, 0}, 2);
  for (const PanelAlteration& panel : result.panels) {
    ASSERT_EQ(panel.insertions.size(), 1u);
    EXPECT_NEAR(panel.insertions[0].area * kPerCm2, 480, 1);
  }
}

}  // namespace
}  // namespace toile
