// SPDX-License-Identifier: GPL-3.0-or-later
// Cases 7-14 of the method: alterations whose areas are known exactly (in square centimetres here).
#include "engine/alter/alter_pattern.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/geometry/inner_point.h"
#include "engine/stages/mesh_panels.h"
#include "tests/engine/alter/altered_grid.h"
#include "tests/support/count_tears.h"

namespace toile {
namespace {

using test::alter;
using test::grid_garment;
using test::GridGarment;
using test::kPerCm2;
using test::Map;

GridGarment sheet(double spacing = 0.02, double jitter = 0.2) {
  return grid_garment({{"front", 0.4, 0.6, static_cast<int>(0.4 / spacing), static_cast<int>(0.6 / spacing), jitter}});
}

struct Areas {
  double inserted, removed;
};

void expect_areas(const AlterPatternResult& result, const Areas& wanted, double tolerance) {
  EXPECT_NEAR(result.inserted_area * kPerCm2, wanted.inserted, tolerance);
  EXPECT_NEAR(result.removed_area * kPerCm2, wanted.removed, tolerance);
  EXPECT_LT(result.area_imbalance, 0.01);
  EXPECT_TRUE(result.flags.empty()) << result.flags.front();
}

Map scaled(double wide, double tall) {
  return [=](int, const Vec2& p) { return Vec2(wide * p.x(), tall * p.y()); };
}

GridGarment with_locked_sides(GridGarment garment, const std::vector<int>& edges) {
  for (const int edge : edges) garment.pattern.panels[0].edges[static_cast<std::size_t>(edge)].locked = true;
  return garment;
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

// Straight down to 40 cm above the hem, then wider: the cut from the hem ends where the gore does.
TEST(AlterPattern, Case12EndsTheCutWhereTheGoreEnds) {
  const auto gore = [](int, const Vec2& p) {
    return Vec2(0.2 + (p.x() - 0.2) * (0.4 + 0.12 * std::max(0.0, (0.4 - p.y()) / 0.4)) / 0.4, p.y());
  };
  for (const bool along_edges : {false, true}) {
    AlterPatternOptions options;
    options.mesh_edge_cuts = along_edges;
    const AlterPatternResult result = alter(with_locked_sides(sheet(), {1, 2, 3}), gore, options);
    ASSERT_EQ(result.panels[0].cut_lines.size(), 1u);
    const auto& line = result.panels[0].cut_lines[0];
    EXPECT_NEAR(std::max(line.front().y(), line.back().y()), 0.4, 2 * 0.02);
    EXPECT_NEAR(result.inserted_area * kPerCm2, 240, 10);
  }
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

GridGarment on_the_mid_plane(GridGarment garment) {
  garment.pattern.panels[0].translation = {-0.2, 0, 0};
  return garment;
}

TEST(AlterPattern, LetsASideGoRatherThanCut) {
  const AlterPatternResult result = alter(sheet(), scaled(1.2, 1));
  EXPECT_EQ(test::tears_of(result, TearKind::Edge), 0u);
  EXPECT_EQ(test::tears_of(result, TearKind::Release), 1u);
}

TEST(AlterPattern, CutsWhereBothSidesAreLocked) {
  const AlterPatternResult result = alter(with_locked_sides(sheet(), {1, 3}), scaled(1.2, 1));
  EXPECT_EQ(test::tears_of(result, TearKind::Release), 0u);
  EXPECT_EQ(test::tears_of(result, TearKind::Edge), 1u);
  expect_areas(result, {480, 0}, 1);
}

TEST(AlterPattern, ThetaZeroForbidsCuts) {
  AlterPatternOptions options;
  options.max_tears_per_side = 0;
  const AlterPatternResult result = alter(with_locked_sides(sheet(), {1, 3}), scaled(1.2, 1), options);
  EXPECT_EQ(test::tears_of(result, TearKind::Edge), 0u);
  EXPECT_FALSE(result.flags.empty());
}

TEST(AlterPattern, CutsKeepOutOfAPocketAndTakeAnotherPlaceIfThetaGivesIt) {
  GridGarment garment = with_locked_sides(sheet(), {1, 3});
  garment.pattern.panels[0].keep_outs = {{{{0.16, 0.2}, {0.24, 0.2}, {0.24, 0.3}, {0.16, 0.3}}, "pocket"}};
  AlterPatternOptions options;
  EXPECT_EQ(test::tears_of(alter(garment, scaled(1.2, 1), options), TearKind::Edge), 0u);
  options.max_tears_per_side = 2;
  const AlterPatternResult result = alter(garment, scaled(1.2, 1), options);
  expect_areas(result, {480, 0}, 1);
  ASSERT_FALSE(result.panels[0].cut_lines.empty());
  for (const Vec2& p : result.panels[0].cut_lines[0]) EXPECT_GT(std::abs(p.x() - 0.2), 0.04);
}

// The cut would run down the middle, about x = 0.21.
TEST(AlterPattern, NoCutPassesCloseByTheTipOfADart) {
  for (const double tip : {0.12, 0.202}) {
    Panel panel;
    panel.name = "front";
    panel.corners = {{0, 0}, {0.4, 0}, {0.4, 0.6}, {0, 0.6}, {0, 0.32}, {tip, 0.3}, {0, 0.28}};
    panel.edges.resize(panel.corners.size());
    for (const std::size_t edge : {1, 3, 6}) panel.edges[edge].locked = true;
    Pattern pattern;
    pattern.panels = {panel};
    pattern.seams = {{{PanelId(0), 4}, {PanelId(0), 5}, false}};
    const PatternMesh mesh = mesh_panels(pattern, {1500, {}});
    Points2 wide = mesh.rest;
    wide.col(0) *= 1.2;
    const AlterPatternResult result = alter_pattern(pattern, mesh, wide, {});
    EXPECT_EQ(test::tears_of(result, TearKind::Edge), tip < 0.19 ? 1u : 0u) << tip;
    EXPECT_EQ(result.flags.empty(), tip < 0.19);
  }
}

TEST(AlterPattern, ALockedPanelIsLeftAlone) {
  GridGarment garment = sheet();
  garment.pattern.panels[0].locked = true;
  const AlterPatternResult result = alter(garment, scaled(1.2, 1));
  EXPECT_EQ(result.inserted_area, 0.0);
  EXPECT_EQ(result.flags.size(), 1u);
}

TEST(AlterPattern, ALargerAllowedStretchNeedsNoOperation) {
  AlterPatternOptions options;
  EXPECT_EQ(alter(sheet(), scaled(1.04, 1), options).ticket.operations.size(), 1u);
  options.stretch_limit = 0.05;
  EXPECT_TRUE(alter(sheet(), scaled(1.04, 1), options).ticket.operations.empty());
}

// 2.5 % are within the allowed 3, but of a metre they are a hem 25 mm too high.
TEST(AlterPattern, LongClothKeepsLessStrainThanShortCloth) {
  const GridGarment tall = grid_garment({{"leg", 0.3, 1.0, 15, 50, 0.2}});
  const AlterPatternResult lengthened = alter(tall, scaled(1, 1.025));
  ASSERT_EQ(lengthened.ticket.operations.size(), 1u);
  EXPECT_EQ(lengthened.ticket.operations[0].kind, OperationKind::Lengthen);
  EXPECT_NEAR(lengthened.inserted_area * kPerCm2, 75, 1);
  const GridGarment low = grid_garment({{"cuff", 0.3, 0.3, 15, 15, 0.2}});
  EXPECT_TRUE(alter(low, scaled(1, 1.025)).ticket.operations.empty());
}

TEST(AlterPattern, SymmetryWidensBothSidesAlike) {
  const GridGarment garment = on_the_mid_plane(sheet(0.02, 0.0));
  AlterPatternOptions options;
  const AlterPatternResult both = alter(garment, scaled(1.2, 1), options);
  ASSERT_EQ(both.panels[0].insertions.size(), 2u);
  EXPECT_NEAR(both.panels[0].insertions[0].area, both.panels[0].insertions[1].area, 1e-4);
  EXPECT_EQ(both.ticket.operations.size(), 1u);
  options.symmetric = false;
  EXPECT_EQ(alter(garment, scaled(1.2, 1), options).panels[0].insertions.size(), 1u);
}

// A straight waistband for a body whose own is longer and bent, at one end a little more than at the other.
TEST(AlterPattern, ABandThatIsItsOwnMirrorImageGrowsAsMuchAtBothEnds) {
  constexpr double kWidth = 0.43;  // m
  GridGarment garment = grid_garment({{"band", kWidth, 0.045, 32, 3, 0.0}});
  garment.pattern.panels[0].translation = {-kWidth / 2, 0, 0};
  const Map bent = [](int, const Vec2& p) {
    const double x = p.x() - kWidth / 2;
    return Vec2(1.05 * p.x(), p.y() + 0.8 * x * x * (1.0 + 0.3 * x));
  };
  const AlterPatternResult result = alter(garment, bent);
  ASSERT_EQ(result.panels[0].insertions.size(), 2u);
  const double left = result.panels[0].insertions[0].area, right = result.panels[0].insertions[1].area;
  EXPECT_NEAR(left, right, 0.05 * (left + right));
}

TEST(AlterPattern, TheSymmetryPlaneSaysWhatIsTheMiddle) {
  GridGarment garment = sheet(0.02, 0.0);
  garment.pattern.panels[0].translation = {0.1, 0, 0};
  EXPECT_EQ(alter(garment, scaled(1.2, 1)).panels[0].insertions.size(), 1u);
  garment.pattern.symmetry = Pattern::Symmetry::Plane;
  garment.pattern.symmetry_plane = {1, 0, 0, 0.3};
  EXPECT_EQ(alter(garment, scaled(1.2, 1)).panels[0].insertions.size(), 2u);
}

// Of one plan: a garment that is tried on and rests off its place is planned again (alter_in_loop).
TEST(AlterPattern, AHigherAllowedStretchNeverNeedsMoreOperations) {
  std::size_t before = 1000;
  for (const double mu : {0.01, 0.03, 0.05, 0.1, 0.25}) {
    AlterPatternOptions options;
    options.stretch_limit = mu;
    const std::size_t operations = alter(sheet(), scaled(1.2, 1.04), options).ticket.operations.size();
    EXPECT_LE(operations, before) << mu;
    before = operations;
  }
  EXPECT_EQ(before, 0u);
}

TEST(AlterPattern, LShapesStayWhole) {
  AlterPatternOptions options;
  EXPECT_GT(alter(sheet(), scaled(1.2, 1.2), options).panels[0].insertions.size(), 1u);
  options.l_shapes = true;
  EXPECT_EQ(alter(sheet(), scaled(1.2, 1.2), options).panels[0].insertions.size(), 1u);
}

TEST(AlterPattern, NoCutOpensLessThanTheLeastStrip) {
  const GridGarment garment = with_locked_sides(sheet(), {1, 3});
  AlterPatternOptions options;  // 20 mm are asked for
  options.least_strip = 0.03;
  EXPECT_EQ(test::tears_of(alter(garment, scaled(1.05, 1), options), TearKind::Edge), 0u);
  options.least_strip = 0.015;
  EXPECT_EQ(test::tears_of(alter(garment, scaled(1.05, 1), options), TearKind::Edge), 1u);
}

TEST(AlterPattern, AStripAtASeamHasTheLeastWidthUnlessTheAllowanceGivesWhatIsAsked) {
  GridGarment garment = with_locked_sides(sheet(), {1});
  AlterPatternOptions options;  // 20 mm are asked for
  options.least_strip = 0.03;
  const AlterPatternResult strip = alter(garment, scaled(1.05, 1), options);
  expect_areas(strip, {180, 60}, 1);  // 10 mm of the old cloth give way
  EXPECT_EQ(strip.ticket.operations.at(0).fabric, FabricNeed::NeedsFabric);
  garment.pattern.panels[0].edges[3].seam_allowance = 0.03;
  const AlterPatternResult result = alter(garment, scaled(1.05, 1), options);
  expect_areas(result, {120, 0}, 1);
  EXPECT_EQ(result.ticket.operations.at(0).fabric, FabricNeed::WithinAllowance);
}

// Its depth is more than the least width, but it soon ends in nothing: it is made deeper until there is room in it.
TEST(AlterPattern, AShortWedgeHasRoomForTheLeastWidth) {
  const auto corner = [](int, const Vec2& p) {
    return Vec2(p.x() - (1 - p.x() / 0.4) * 0.052 * std::max(0.0, (p.y() - 0.4) / 0.2), p.y());
  };
  AlterPatternOptions options;
  options.least_strip = 0.05;
  const AlterPatternResult result = alter(with_locked_sides(sheet(), {1}), corner, options);
  ASSERT_EQ(result.panels[0].insertions.size(), 1u);
  EXPECT_GT(2 * roomiest_point(result.panels[0].insertions[0].shape.outline).clearance, 0.97 * options.least_strip);
  EXPECT_GT(result.panels[0].cut_back, 0.0);
  EXPECT_LT(result.area_imbalance, 0.01);
}

TEST(AlterPattern, ScaleChangesNothingButTheNumbers) {
  const auto flare = [](int, const Vec2& p) { return Vec2(p.x() * (0.52 - 0.12 * p.y() / 0.6) / 0.4, p.y()); };
  const AlterPatternResult once = alter(sheet(), flare);
  GridGarment large = sheet();
  large.mesh.rest *= 1.5;
  for (Vec2& corner : large.pattern.panels[0].corners) corner *= 1.5;
  const AlterPatternResult result = alter(large, [&](int, const Vec2& p) { return Vec2(1.5 * flare(0, p / 1.5)); });
  ASSERT_EQ(result.panels[0].insertions.size(), once.panels[0].insertions.size());
  EXPECT_NEAR(result.inserted_area, 2.25 * once.inserted_area, 0.01 * result.inserted_area);
}

TEST(AlterPattern, CutsAlongMeshEdgesReachTheSameAreas) {
  AlterPatternOptions options;
  options.mesh_edge_cuts = true;
  const GridGarment garment = with_locked_sides(sheet(), {1, 3});
  const AlterPatternResult result = alter(garment, scaled(1.2, 1), options);
  EXPECT_EQ(test::tears_of(result, TearKind::Edge), 1u);
  EXPECT_NEAR(result.inserted_area * kPerCm2, 480, 10);
}

}  // namespace
}  // namespace toile
