// SPDX-License-Identifier: GPL-3.0-or-later
// The altered garment as a pattern: areas add up, every seam joins what it should, and the cloth is the original's.
#include "engine/alter/sew_altered.h"

#include <map>

#include <gtest/gtest.h>

#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"
#include "tests/engine/alter/altered_grid.h"

namespace toile {
namespace {

using test::alter;
using test::grid_garment;
using test::GridGarment;
using test::kPerCm2;
using test::Map;

constexpr double kSameLength = 5e-4;  // m: sewn sides against their intended lengths

GridGarment sheet() {
  return grid_garment({{"front", 0.4, 0.6, 20, 30, 0.2}});
}

double area_of(const SewnPattern& sewn, bool insertions) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sewn.pieces.size(); ++i)
    if ((sewn.pieces[i].insertion >= 0) == insertions) sum += std::abs(outline_signed_area(sewn.pattern.panels[i]));
  return sum * kPerCm2;
}

void expect_sound(const SewnPattern& sewn) {
  ASSERT_EQ(sewn.pattern.panels.size(), sewn.pieces.size());
  ASSERT_EQ(sewn.pattern.seams.size(), sewn.seams.size());
  for (const std::string& flag : sewn.flags) ADD_FAILURE() << flag;
  EXPECT_NO_THROW(validate_pattern(sewn.pattern));
  for (std::size_t s = 0; s < sewn.seams.size(); ++s) {
    const auto length = [&](const SeamSide& side) { return edge_length(sewn.pattern.panel(side.panel), side.edge); };
    EXPECT_NEAR(length(sewn.pattern.seams[s].a), sewn.seams[s].length_a, kSameLength);
    EXPECT_NEAR(length(sewn.pattern.seams[s].b), sewn.seams[s].length_b, kSameLength);
  }
}

Map scaled(double wide, double tall) {
  return [=](int, const Vec2& p) { return Vec2(wide * p.x(), tall * p.y()); };
}

TEST(SewAltered, LeavesAnUnchangedPatternAsItIs) {
  const GridGarment garment = sheet();
  const AlterPatternResult result = alter(garment, scaled(1, 1));
  expect_sound(result.sewn);
  ASSERT_EQ(result.sewn.pattern.panels.size(), 1u);
  const Panel &before = garment.pattern.panels[0], &after = result.sewn.pattern.panels[0];
  ASSERT_EQ(after.edge_count(), before.edge_count());
  double farthest = 0.0;
  for (const Vec2& p : before.corners) {
    double nearest = 1.0;
    for (const Vec2& q : after.corners) nearest = std::min(nearest, (p - q).norm());
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 1e-9);
}

TEST(SewAltered, SewsAStripToTheKeptPanel) {
  const AlterPatternResult result = alter(sheet(), scaled(1.2, 1));
  expect_sound(result.sewn);
  ASSERT_EQ(result.sewn.pieces.size(), 2u);
  EXPECT_EQ(result.sewn.pattern.seams.size(), 1u);
  EXPECT_NEAR(area_of(result.sewn, false), 2400, 1);
  EXPECT_NEAR(area_of(result.sewn, true), 480, 1);
}

TEST(SewAltered, CutsTheTakenInPanelSmaller) {
  const GridGarment wide = grid_garment({{"front", 0.48, 0.6, 24, 30, 0.2}});
  const AlterPatternResult result = alter(wide, scaled(1 / 1.2, 1));
  expect_sound(result.sewn);
  ASSERT_EQ(result.sewn.pieces.size(), 1u);
  EXPECT_NEAR(area_of(result.sewn, false), 2400, 2);
}

TEST(SewAltered, InsertsAndRemovesInOnePanel) {
  const AlterPatternResult result = alter(sheet(), scaled(1.2, 50.0 / 60));
  expect_sound(result.sewn);
  EXPECT_NEAR(area_of(result.sewn, false), 2000, 10);
  EXPECT_NEAR(area_of(result.sewn, true), 400, 2);
  for (const SewnPiece& piece : result.sewn.pieces) EXPECT_LT(piece.strain, 0.03);
}

TEST(SewAltered, LetsAWedgeIntoTheClothWithWhatIsTurnedIn) {
  const auto flare = [](int, const Vec2& p) { return Vec2(p.x() * (0.52 - 0.12 * p.y() / 0.6) / 0.4, p.y()); };
  const AlterPatternResult result = alter(sheet(), flare);
  expect_sound(result.sewn);
  EXPECT_NEAR(area_of(result.sewn, true) + area_of(result.sewn, false), 2400 + 360, 15);
}

GridGarment all_locked() {
  GridGarment garment = sheet();
  for (PanelEdge& edge : garment.pattern.panels[0].edges) edge.locked = true;
  garment.pattern.panels[0].keep_outs = {{{Vec2(0.1, 0.1), Vec2(0.3, 0.1), Vec2(0.3, 0.5)}, "pocket"}};
  return garment;
}

// To a target so wide and 0.7 as long.
AlterPatternResult alter_without_tears(const GridGarment& garment, double width) {
  AlterPatternOptions options;
  options.max_tears_per_side = 0;
  return alter_pattern(garment.pattern, garment.mesh, garment.mapped(scaled(width, 0.7)), options);
}

TEST(SewAltered, ASeamWhoseSidesAreNotAlikeIsAFault) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 20, 30}, {"back", 0.4, 0.6, 20, 30}}, {{0, 1, 1, 3}});
  AlterPatternResult result = alter(garment, [](int, const Vec2& p) { return Vec2(1.2 * p.x(), p.y()); });
  ASSERT_FALSE(result.sewn.seams.empty());
  EXPECT_EQ(faults_of(result), 0u);
  EXPECT_TRUE(unlike_seams(result.sewn).empty());
  result.sewn.seams[0].eased += 0.002;
  EXPECT_GT(seam_mismatch(result.sewn), 0.0015);
  EXPECT_EQ(faults_of(result), 1u);
  result.sewn.seams[0].eased += 0.005;
  ASSERT_EQ(unlike_seams(result.sewn).size(), 1u);
  EXPECT_NE(unlike_seams(result.sewn)[0].find("7 mm too long"), std::string::npos) << unlike_seams(result.sewn)[0];
}

TEST(SewAltered, CutsAPanelThatNoTearBringsNearAnewOutOfItsOwnCloth) {
  const GridGarment garment = all_locked();
  const AlterPatternResult result = alter_without_tears(garment, 0.6);
  expect_sound(result.sewn);
  EXPECT_TRUE(result.flags.empty());
  ASSERT_EQ(result.sewn.pieces.size(), 1u);
  EXPECT_TRUE(result.sewn.pieces[0].recut && result.sewn.pieces[0].own_cloth);
  const Panel& before = garment.pattern.panels[0];
  for (const Vec2& corner : result.sewn.pattern.panels[0].corners)
    EXPECT_TRUE(inside_polygon(before.corners, corner)) << corner.transpose();
  EXPECT_NEAR(area_of(result.sewn, false), 2400 * 0.6 * 0.7, 1);
  ASSERT_EQ(result.ticket.operations.size(), 1u);
  const TicketOperation& operation = result.ticket.operations[0];
  EXPECT_EQ(operation.kind, OperationKind::CutAnew);
  EXPECT_EQ(operation.fabric, FabricNeed::None);
  EXPECT_EQ(operation.touches, std::vector<std::string>{"pocket"});
}

TEST(SewAltered, AsksForNewClothWhereThePanelsOwnIsTooSmall) {
  const AlterPatternResult result = alter_without_tears(all_locked(), 1.3);
  expect_sound(result.sewn);
  ASSERT_EQ(result.flags.size(), 1u);
  EXPECT_NE(result.flags[0].find("new cloth"), std::string::npos);
  EXPECT_FALSE(result.sewn.pieces.at(0).own_cloth);
  EXPECT_EQ(result.ticket.operations.at(0).fabric, FabricNeed::NeedsFabric);
  EXPECT_LT(result.area_imbalance, 1e-9);
}

TEST(SewAltered, WhatIsCutAnewOnTheLeftIsCutAnewOnTheRight) {
  GridGarment pair = grid_garment({{"left", 0.4, 0.6, 20, 30, 0.0}, {"right", 0.4, 0.6, 20, 30, 0.0}});
  pair.pattern.panels[0].translation = {-0.5, 0, 0};
  pair.pattern.panels[1].translation = {0.1, 0, 0};
  for (Panel& panel : pair.pattern.panels)
    for (PanelEdge& edge : panel.edges) edge.locked = true;
  const auto smaller_left = [](int panel, const Vec2& p) { return panel == 0 ? Vec2(0.6 * p.x(), 0.7 * p.y()) : p; };
  AlterPatternOptions options;
  options.max_tears_per_side = 0;
  for (const bool symmetric : {true, false}) {
    options.symmetric = symmetric;
    const AlterPatternResult result = alter(pair, smaller_left, options);
    ASSERT_EQ(result.sewn.pieces.size(), 2u);
    EXPECT_TRUE(result.sewn.pieces[0].recut);
    EXPECT_EQ(result.sewn.pieces[1].recut, symmetric);
    ASSERT_EQ(result.ticket.operations.size(), 1u);
    EXPECT_EQ(result.ticket.operations[0].sides.size(), symmetric ? 2u : 1u);
  }
}

TEST(SewAltered, EveryPanelCutAnewThatIsNoMirrorImageIsAnOperationOfItsOwn) {
  GridGarment pair = grid_garment({{"front", 0.4, 0.6, 20, 30, 0.0}, {"back", 0.4, 0.6, 20, 30, 0.0}});
  for (Panel& panel : pair.pattern.panels)
    for (PanelEdge& edge : panel.edges) edge.locked = true;
  AlterPatternOptions options;
  options.max_tears_per_side = 0;
  const AlterPatternResult result = alter(
      pair, [](int, const Vec2& p) { return Vec2(0.6 * p.x(), 0.7 * p.y()); }, options);
  ASSERT_EQ(result.ticket.operations.size(), 2u);
  EXPECT_EQ(result.ticket.operations[0].where, "front");
  EXPECT_EQ(result.ticket.operations[1].where, "back");
}

// Both plies of every seam as drawn, against what the target eases there.
void expect_plies_alike(const SewnPattern& sewn) {
  for (std::size_t s = 0; s < sewn.seams.size(); ++s) {
    const Seam& seam = sewn.pattern.seams[s];
    const auto length = [&](const SeamSide& side) { return edge_length(sewn.pattern.panel(side.panel), side.edge); };
    EXPECT_NEAR(length(seam.a) - length(seam.b), sewn.seams[s].eased, kSameLength)
        << sewn.pattern.panel(seam.a.panel).name << " and " << sewn.pattern.panel(seam.b.panel).name;
  }
}

// The kept cloth keeps 1.4 % of stretch lengthwise, so it is 8 mm shorter than its place in the target.
TEST(SewAltered, AStripIsAsLongAsTheStrainedClothItIsSewnTo) {
  const AlterPatternResult result = alter(sheet(), scaled(1.2, 1.014));
  ASSERT_EQ(result.sewn.pieces.size(), 2u);
  expect_sound(result.sewn);
  expect_plies_alike(result.sewn);
  EXPECT_NEAR(result.sewn.seams.at(0).length_a, 0.6, 2e-3);
}

// A panel with a dart in its lower edge; the target has the dart farther to the right and is longer below its mouth.
TEST(SewAltered, AStripAcrossADartThatMovesMeetsTheClothOrThePanelIsCutAnew) {
  Pattern pattern;
  Panel panel;
  panel.name = "back";
  panel.corners = {{0, 0}, {0.17, 0}, {0.2, 0.15}, {0.23, 0}, {0.5, 0}, {0.5, 0.4}, {0, 0.4}};
  panel.edges.resize(panel.corners.size());
  pattern.panels = {panel};
  pattern.seams = {{{PanelId(0), 1}, {PanelId(0), 2}, false}};
  const PatternMesh mesh = mesh_panels(pattern, {1500, {}});
  for (const double moved : {0.0, 0.12}) {
    Points2 target = mesh.rest;
    for (Eigen::Index v = 0; v < target.rows(); ++v) {
      const double x = target(v, 0), y = target(v, 1);
      const double near = std::max(0.0, 1.0 - std::abs(x - 0.2) / 0.19) * std::max(0.0, 1.0 - y / 0.4);
      target(v, 0) = x + moved * near;
      target(v, 1) = y < 0.06 ? y - 0.08 * (1.0 - y / 0.06) : y;
    }
    const AlterPatternResult result = alter_pattern(pattern, mesh, target, {});
    const SewnPattern& sewn = result.sewn;
    ASSERT_FALSE(sewn.pieces.empty()) << moved;
    std::map<std::pair<int, int>, Vec2> plies;
    for (std::size_t k = 0; k < sewn.seams.size(); ++k) {
      const int a = sewn.pattern.seams[k].a.panel.value, b = sewn.pattern.seams[k].b.panel.value;
      const Vec2 lengths(sewn.seams[k].length_a, sewn.seams[k].length_b);
      plies.emplace(std::minmax(a, b), Vec2::Zero()).first->second += a <= b ? lengths : Vec2(lengths.reverse());
    }
    for (const auto& [pieces, lengths] : plies)
      EXPECT_LE(lengths.maxCoeff() - lengths.minCoeff(), std::max(8e-3, 0.33 * lengths.maxCoeff())) << moved;
    EXPECT_EQ(sewn.pieces[0].recut, moved > 0.0) << moved;  // a dart that stays is no reason
  }
}

TEST(SewAltered, SewsADartIntoThePanel) {
  const auto dart = [](int, const Vec2& p) {
    const double narrow = 0.04 * std::max(0.0, (p.y() - 0.35) / 0.25);
    return Vec2(narrow + p.x() * (0.4 - 2 * narrow) / 0.4, p.y());
  };
  const AlterPatternResult result = alter(sheet(), dart);
  expect_sound(result.sewn);
  EXPECT_NEAR(area_of(result.sewn, false), 2300, 10);
}

}  // namespace
}  // namespace toile
