// SPDX-License-Identifier: GPL-3.0-or-later
// Every garment of ../shared/data from flat on its body, and what is measured must hold.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/stages/carry_drape.h"
#include "engine/stages/drape_held.h"
#include "tests/support/dressed.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

void expect_worn(const DrapeResult& result) {
  EXPECT_EQ(result.quality.nodes_inside, 0);
  EXPECT_EQ(result.quality.edges_inside, 0) << result.quality.deepest_edge;
  EXPECT_LT(result.quality.residual, 3.0);
  EXPECT_EQ(result.diagnostics.rung, 0);
  for (const DrapeFinding& finding : result.diagnostics.findings) EXPECT_FALSE(finding.refused) << finding.message;
}

class SlowDrapeOfGarment : public testing::TestWithParam<std::string> {};

TEST_P(SlowDrapeOfGarment, FromFlatHangsWhereItBelongs) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing d = test::dress(GetParam(), 4300);
  const DrapeResult result = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  expect_worn(result);
  EXPECT_NE(result.quality.rest, Rest::NotAtRest) << result.quality.settling_move;
  EXPECT_LE(result.quality.crossing_share, 0.005);
  const test::Place place = test::expected_place(GetParam());
  EXPECT_NEAR(result.drape.nodes.col(1).minCoeff(), place.lowest, 0.010);
  EXPECT_NEAR(test::waist_height(d.pattern, d.mesh, result.drape), place.waist, 0.010);  // both 0 without a waist line
}

INSTANTIATE_TEST_SUITE_P(SlowAllGarments, SlowDrapeOfGarment, testing::ValuesIn(test::shared_garment_names()),
                         [](const auto& garment) { return garment.param; });

// Size, shape and pose of another body, the placement untouched.
TEST(SlowDrape, OtherBodiesAreDressedUnattended) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* body : {"ggg_large_male", "mh_female_average", "mh_male_old_heavy"})
    for (const char* garment : {"tshirt_basic", "pants_straight", "dress_sleeveless"}) {
      SCOPED_TRACE(std::string(garment) + " on " + body);
      const test::Dressing d = test::dress(garment, 4300, body);
      expect_worn(drape(d.pattern, d.mesh, d.body, d.options, nullptr));  // the dress is a third too small for the man
    }
}

// Sleeves and trouser legs that end at the hands and feet of a smaller body, whose fingers and toes find their way
// between the nodes.
TEST(SlowDrape, FingersAndToesDoNotPierceTheCloth) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* garment : {"m_pants", "shirt_darts_long", "sweater_loose_hood"}) {
    SCOPED_TRACE(garment);
    const test::Dressing d = test::dress(garment, 4300, "mh_female_average");
    expect_worn(drape(d.pattern, d.mesh, d.body, d.options, nullptr));
  }
}

// Its panels lie nearer this body's arms than its trunk, but were placed round another one.
TEST(SlowDrape, PanelsAreKnownByTheBodyTheyWerePlacedRound) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing d = test::dress("gc_shirt_mean", 2000, "mh_female_average");
  const DrapeResult result = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  EXPECT_TRUE(result.diagnostics.bodice);
  expect_worn(result);
}

// Adults' dresses on a small thin woman: their shoulders slip as designed, and sit when they start higher.
TEST(SlowDrape, SecondRungOfTheLadderDressesWhomTheFirstDoesNot) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* garment : {"f_dress_sleeveless", "gc_dress_pencil"}) {
    SCOPED_TRACE(garment);
    const test::Dressing d = test::dress(garment, 1500, "mh_female_thin_short");
    const DrapeResult result = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
    EXPECT_EQ(result.diagnostics.rung, 1);
    EXPECT_NE(result.quality.rest, Rest::NotAtRest);
    EXPECT_EQ(result.quality.nodes_inside, 0);
    EXPECT_EQ(result.quality.edges_inside, 0);
  }
}

// Where both do, they end at the same place.
TEST(SlowDrape, SecondRungOfTheLadderDressesAlone) {
  TOILE_REQUIRE_SHARED_DATA();
  test::Dressing d = test::dress("tshirt_basic", 3000);
  d.options.first_rung = 1;
  const DrapeResult result = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  EXPECT_EQ(result.diagnostics.rung, 1);
  EXPECT_EQ(result.quality.nodes_inside, 0);
  EXPECT_NEAR(result.drape.nodes.col(1).minCoeff(), test::expected_place("tshirt_basic").lowest, 0.015);
}

TEST(SlowDrape, GarmentThatIsNowhereNearTheBodyIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  test::Dressing d = test::dress("tshirt_basic", 2000);
  for (Panel& panel : d.pattern.panels) panel.translation.y() -= 0.6;
  d.options.iterations = 200;
  try {
    drape(d.pattern, d.mesh, d.body, d.options, nullptr);
    FAIL() << "a T-shirt placed at the knees was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::DrapeFailed);
  }
}

// Far too small at the armpits, pressed layer on layer there; toes and fingers thinner than the field's lattice.
TEST(SlowDrape, SettledMeansAllNodesAndTheBodyItself) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing shirt = test::dress("shirt_darts_long", 4300, "mh_male_old_heavy");
  const DrapeResult tight = drape(shirt.pattern, shirt.mesh, shirt.body, shirt.options, nullptr);
  EXPECT_EQ(rest_name(tight.quality.rest), "settled");
  expect_worn(tight);
  const test::Dressing suit = test::dress("gc_jumpsuit_mean_all", 10000, "mh_female_average");
  expect_worn(drape(suit.pattern, suit.mesh, suit.body, suit.options, nullptr));
}

TEST(SlowDrape, GoesOnFromItsEndWhereFrictionIsHeld) {
  TOILE_REQUIRE_SHARED_DATA();
  test::Dressing d = test::dress("skirt_pencil", 2000);
  HeldDrape end;
  const Drape first = drape_to_hold(d.pattern, d.mesh, d.body, d.options, end, nullptr).drape;
  const Drape on = drape_held(d.pattern, d.mesh, d.body, first, end, d.options, nullptr).drape;
  EXPECT_LT(std::sqrt((on.nodes - first.nodes).rowwise().squaredNorm().mean()), 0.001);
  EXPECT_NEAR(test::waist_height(d.pattern, d.mesh, on), test::waist_height(d.pattern, d.mesh, first), 2e-4);
  end.friction.load.conservativeResize(5);
  EXPECT_THROW(drape_held(d.pattern, d.mesh, d.body, first, end, d.options, nullptr), Error);
}

// Friction lets the dress rest up to a centimetre higher or lower; all meshes take the same of these states.
TEST(SlowDrape, FinerMeshRestsWhereTheCoarseOneDoes) {
  TOILE_REQUIRE_SHARED_DATA();
  const auto lowest = [](int triangles, int coarse_triangles) {
    test::Dressing d = test::dress("dress_sleeveless", triangles);
    d.options.coarse_triangles = coarse_triangles;
    const DrapeResult result = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
    expect_worn(result);
    return result.drape.nodes.col(1).minCoeff();
  };
  const int usual = DrapeOptions().coarse_triangles;
  const double coarse = lowest(usual, usual);
  EXPECT_GT(std::abs(lowest(20000, 0) - coarse), 0.004);  // from flat on its own
  EXPECT_LT(std::abs(lowest(20000, usual) - coarse), 0.001);
}

// Folds stay where the meshes in between put them: twice the triangles from 4,000 alone fall 1.6 mm apart.
TEST(SlowDrape, FinestMeshKeepsTheFoldsOfThoseBetween) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing fine = test::dress("skirt_pencil", 20000), finer = test::dress("skirt_pencil", 40000);
  DrapeEnd end;
  end.drape = drape_to_hold(fine.pattern, fine.mesh, fine.body, fine.options, end.held, nullptr).drape;
  const Drape there = drape(finer.pattern, finer.mesh, finer.body, finer.options, nullptr).drape;
  const Drape carried = carry_drape(fine.pattern, fine.mesh, end, finer.mesh).drape;
  EXPECT_LT(std::sqrt((there.nodes - carried.nodes).rowwise().squaredNorm().mean()), 0.0012);
}

TEST(SlowDrape, WholeGarmentMovesWhereAHalfDoesNotComeToRest) {
  TOILE_REQUIRE_SHARED_DATA();
  test::Dressing d = test::dress("leggings_tight", 4300, "mh_female_average");
  const DrapeResult half = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  EXPECT_NE(half.quality.rest, Rest::NotAtRest);
  EXPECT_LT(half.diagnostics.moved_nodes, 0.6 * d.mesh.node_count);
  d.options.iterations = half.diagnostics.iterations / 4;
  const DrapeResult whole = drape(d.pattern, d.mesh, d.body, d.options, nullptr);
  EXPECT_EQ(whole.diagnostics.moved_nodes, d.mesh.node_count);
}

TEST(SlowDrape, SameInputsGiveTheSameBytes) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::Dressing d = test::dress("skirt_pencil", 2000);
  const Drape once = drape(d.pattern, d.mesh, d.body, d.options, nullptr).drape;
  const Drape again = drape(d.pattern, d.mesh, d.body, d.options, nullptr).drape;
  EXPECT_EQ((once.nodes - again.nodes).cwiseAbs().maxCoeff(), 0);
}

}  // namespace
}  // namespace toile
