// SPDX-License-Identifier: GPL-3.0-or-later
// Alterations are tried on and planned again where the altered garment rests off its place.
#include "engine/alter_in_loop.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/archive_stages.h"
#include "engine/stages/build_fitting_map.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

constexpr double kWidth = 0.5, kHeight = 0.6, kTop = 1.0, kBeside = 0.4;  // m

// A curtain that hangs from its upper edge beside a form, for a window `longer` times as high. The allowed stretch
// covers what is missing, so that a plan with all of it leaves the curtain as it is: its hem hangs too high.
struct Curtain {
  Body body = test::tube_body("form", 0.1, 1.2);
  Pattern pattern = test::sheet_pattern(kWidth, kHeight, kTop);
  PatternMesh mesh;
  DerivedPattern target;
  Drape place;
  FittingMap fit;

  explicit Curtain(double longer, int fineness = 1) {
    pattern.panels[0].translation.z() = kBeside;
    pattern.pins = {{PanelId{0}, 2}};
    mesh = test::structured_mesh(pattern, 20 * fineness, 24 * fineness);
    const auto lengthened = [&](double y) { return kHeight - longer * (kHeight - y); };
    target.drawn.pattern = pattern;
    for (Vec2& corner : target.drawn.pattern.panels[0].corners) corner.y() = lengthened(corner.y());
    target.mesh = mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) target.mesh.rest(v, 1) = lengthened(mesh.rest(v, 1));
    place = {test::placed_nodes(pattern, target.mesh)};
    target.drape = drape_from(pattern, target.mesh, body, place, {}, nullptr);
    fit = build_fitting_map(mesh, {test::placed_nodes(pattern, mesh)});
  }

  AlterInLoopResult alter(int max_plans, AlterPatternOptions options = {}) const {
    DrapeSeries on_body(body);
    return alter_in_loop(pattern, {mesh, fit, target.mesh, place}, target, on_body, options, {},
                         {.max_plans = max_plans});
  }
};

constexpr double kLonger = 1.01;

TEST(AlterInLoop, PlansAgainWhereTheAlteredGarmentRestsOffItsPlace) {
  const Curtain curtain(kLonger);
  const AlterInLoopResult once = curtain.alter(1), again = curtain.alter(3);
  ASSERT_TRUE(once.altered.ticket.operations.empty());
  ASSERT_GT(once.place.kept_plan().position, once.place.allowed);
  ASSERT_EQ(again.place.plans.size(), 2u);
  EXPECT_EQ(again.place.plans[0].position, once.place.plans[0].position);
  EXPECT_EQ(again.place.kept, 1);
  EXPECT_LE(again.place.kept_plan().position, again.place.allowed);
  ASSERT_EQ(again.altered.ticket.operations.size(), 1u);
  EXPECT_EQ(again.altered.ticket.operations[0].kind, OperationKind::Lengthen);
}

TEST(AlterInLoop, TheNextPlanAllowsLessThanWasLeftOrPlannedWith) {
  const Curtain curtain(kLonger);
  const AlterInLoopResult once = curtain.alter(1), again = curtain.alter(3);
  ASSERT_LT(once.altered.strain_left, 1.0);
  EXPECT_EQ(again.altered.planned_share, again.place.plans[1].share);
  EXPECT_NEAR(again.altered.planned_share, 0.7 * once.altered.strain_left, 1e-12);
  // From there on it goes on as if it had been asked for.
  const AlterInLoopResult from_there = curtain.alter(1, {.planned_share = again.altered.planned_share});
  EXPECT_EQ(to_bytes(from_there.altered), to_bytes(again.altered));
}

TEST(AlterInLoop, OnePlanIsThatOfTheAlterationAlone) {
  const Curtain curtain(kLonger);
  EXPECT_EQ(to_bytes(curtain.alter(1).altered),
            to_bytes(alter_pattern(curtain.pattern, curtain.mesh, curtain.target.mesh.rest)));
}

TEST(AlterInLoop, WhatLiesInItsPlaceIsNotPlannedAgain) {
  for (const double longer : {1.0, 1.02}) {
    const AlterInLoopResult result = Curtain(longer).alter(3);
    EXPECT_EQ(result.place.plans.size(), 1u);
    EXPECT_LE(result.place.kept_plan().position, result.place.allowed);
    EXPECT_EQ(result.altered.ticket.operations.empty(), longer == 1.0);
  }
}

TEST(AlterInLoop, ClothThatKeepsHardlyAnyStrainIsNotPlannedAgain) {
  const AlterInLoopResult result = Curtain(1.03).alter(3);  // swings forward by more than it may
  ASSERT_GT(result.place.kept_plan().position, result.place.allowed);
  EXPECT_LT(result.altered.strain_left, 0.1);
  EXPECT_EQ(result.place.plans.size(), 1u);
}

TEST(AlterInLoop, ATargetPatternThatComesToNoRestTellsNoPlace) {
  Curtain curtain(kLonger);
  curtain.target.drape.quality.rest = Rest::NotAtRest;
  const PlacedPlans place = curtain.alter(3).place;
  ASSERT_GT(place.kept_plan().position, place.allowed);
  EXPECT_FALSE(place.meshed_anew.has_value());
  EXPECT_EQ(place.plans.size(), 1u);
}

TEST(AlterInLoop, TheTargetPatternMeshedAnewIsLookedAtOnlyWhereThePlanIsOffWithoutIt) {
  EXPECT_FALSE(Curtain(1.02).alter(3).place.meshed_anew.has_value());
  const Curtain curtain(kLonger);
  const PlacedPlans off = curtain.alter(3).place;
  ASSERT_TRUE(off.meshed_anew.has_value());
  EXPECT_NEAR(*off.meshed_anew, off.ideal, 2e-4);  // a curtain hangs alike on any mesh
  EXPECT_NEAR(off.allowed, 1.25 * std::max(*off.meshed_anew, off.ideal) + 2e-3, 1e-12);
}

// The mesh a target was derived on may lie where no other mesh of the same pattern does.
TEST(AlterInLoop, NoPlanIsToLieNearerThanTheTargetPatternOnOtherTriangles) {
  Curtain curtain(kLonger);
  constexpr double kSwung = 0.6;  // rad, out of the plane it hangs in, at which nothing keeps it
  for (int n = 0; n < curtain.place.nodes.rows(); ++n) {
    const double below = kTop - curtain.place.nodes(n, 1);
    curtain.place.nodes.row(n) << curtain.place.nodes(n, 0), kTop - std::cos(kSwung) * below,
        kBeside + std::sin(kSwung) * below;
  }
  curtain.target.drape.drape = curtain.place;
  const PlacedPlans place = curtain.alter(3).place;
  EXPECT_EQ(place.ideal, 0.0);
  ASSERT_TRUE(place.meshed_anew.has_value());
  EXPECT_GT(*place.meshed_anew, 1e-2);
  ASSERT_GT(place.kept_plan().position, 2e-3);
  EXPECT_TRUE(place.in_place(place.kept_plan()));
  EXPECT_EQ(place.kept_plan().operations, place.plans.front().operations);
}

TEST(AlterInLoop, AHigherAllowedStretchNeverNeedsMoreOperations) {
  const Curtain curtain(kLonger);
  std::vector<std::size_t> operations;
  for (const double mu : {0.01, 0.03, 0.06, 0.1})
    operations.push_back(curtain.alter(3, {.stretch_limit = mu}).altered.ticket.operations.size());
  EXPECT_TRUE(std::is_sorted(operations.rbegin(), operations.rend()));
  EXPECT_GT(operations.front(), operations.back());
}

TEST(AlterInLoop, AGarmentTriedOnWithItsOwnMeshIsNotDrapedAgain) {
  const Curtain curtain(kLonger);
  const AlterInLoopResult result = curtain.alter(3);
  ASSERT_EQ(result.place.kept, 1);
  const AlterationScene scene{curtain.mesh, curtain.fit, curtain.target.mesh, curtain.target.drape.drape};
  DrapeSeries on_body(curtain.body);
  const DrapedAlteration kept = drape_altered(scene, result.altered.sewn, result.worn, on_body, {}),
                         anew = drape_altered(scene, result.altered.sewn, {}, on_body, {});
  EXPECT_EQ(kept.mesh.triangle_count(), result.place.kept_plan().triangles);
  EXPECT_EQ(to_bytes(kept.drape), to_bytes(result.worn.drape));
  // As if it were draped from the target pattern's drape, and compared with that.
  EXPECT_LT(compare_positions(kept.drape.drape.nodes, anew.drape.drape.nodes).largest, 2e-3);
  EXPECT_NEAR(kept.position.rms, anew.position.rms, 1e-3);
  EXPECT_EQ(to_bytes(kept.reference), to_bytes(anew.reference));
  EXPECT_EQ(Curtain(kLonger, 3).alter(1).worn.mesh.triangle_count(), 0);
}

TEST(AlterInLoop, AFineGarmentIsTriedOnWithACoarserMesh) {
  const AlterInLoopResult coarse = Curtain(kLonger).alter(1), fine = Curtain(kLonger, 3).alter(1);
  EXPECT_NEAR(coarse.place.kept_plan().triangles, 960, 150);
  EXPECT_NEAR(fine.place.kept_plan().triangles, 4000, 800);  // of 8,640, in a grid, which has larger ones
  EXPECT_NEAR(fine.place.kept_plan().position, coarse.place.kept_plan().position, 3e-4);
}

}  // namespace
}  // namespace toile
