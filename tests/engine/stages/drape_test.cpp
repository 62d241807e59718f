// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/drape.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/archive_stages.h"
#include "engine/core/archive.h"
#include "engine/stages/drape_series.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// A tube skirt 4 % tighter than its tube body.
struct TightTube {
  Body body = test::tube_body("tube", 0.14, 1.0);
  Pattern pattern = test::tube_skirt_pattern(0.96 * kTwoPi * 0.14, 0.5, 0.3, 0.17);
  PatternMesh mesh = test::structured_mesh(pattern, 24, 26);
};

TEST(Drape, TubeSkirtFromFlatClosesRoundATubeBody) {
  const TightTube t;
  const DrapeResult result = drape(t.pattern, t.mesh, t.body, {}, nullptr);
  EXPECT_EQ(result.quality.nodes_inside, 0);
  EXPECT_EQ(result.quality.rest, Rest::Converged);
  EXPECT_LT(result.quality.residual, 0.3);
  EXPECT_EQ(result.quality.crossing_pairs, 0);
  const Eigen::VectorXd r =
      (result.drape.nodes.col(0).array().square() + result.drape.nodes.col(2).array().square()).sqrt();
  EXPECT_GT(r.minCoeff(), 0.139);
  EXPECT_LT(r.maxCoeff(), 0.147);
  EXPECT_NEAR(result.drape.nodes.col(1).minCoeff(), 0.3, 0.02);  // friction holds it
  EXPECT_GT(result.quality.weft.p50, 0.04);
}

TEST(Drape, HalfOfASymmetricSkirtComesToRestWhereTheWholeDoes) {
  const TightTube t;
  DrapeOptions whole;
  whole.halve = false;
  const DrapeResult one = drape(t.pattern, t.mesh, t.body, {}, nullptr),
                    both = drape(t.pattern, t.mesh, t.body, whole, nullptr);
  EXPECT_EQ(both.diagnostics.moved_nodes, t.mesh.node_count);
  EXPECT_LT(one.diagnostics.moved_nodes, 0.6 * t.mesh.node_count);
  EXPECT_EQ(one.quality.rest, Rest::Converged);
  EXPECT_LT((one.drape.nodes - both.drape.nodes).rowwise().norm().maxCoeff(), 1e-4);
  EXPECT_NEAR(one.diagnostics.energy, both.diagnostics.energy, 1e-3 * both.diagnostics.energy);
}

TEST(Drape, PaperSolverKeepsTheTightTubeOnTheBody) {
  const TightTube t;
  DrapeOptions options;
  options.solver = SolverKind::Pbd;
  options.iterations = 300;
  options.gravity = 0;
  const DrapeResult result = drape(t.pattern, t.mesh, t.body, options, nullptr);
  EXPECT_EQ(result.quality.nodes_inside, 0);
  EXPECT_GT(result.quality.weft.p50, 0.04);
}

TEST(Drape, NewtonGoesOnFromTheDefaultsEndToTheMinimum) {
  const TightTube t;
  DrapeOptions options;
  const DrapeResult usual = drape(t.pattern, t.mesh, t.body, options, nullptr);
  options.solver = SolverKind::Newton;
  const DrapeResult exact = drape(t.pattern, t.mesh, t.body, options, nullptr);
  EXPECT_GT(usual.quality.residual, 1e-3);
  EXPECT_LT(exact.quality.residual, options.newton_residual);
  EXPECT_LT(exact.diagnostics.energy, usual.diagnostics.energy);
  EXPECT_GT(exact.diagnostics.iterations, usual.diagnostics.iterations);
  EXPECT_LT((exact.drape.nodes - usual.drape.nodes).rowwise().norm().maxCoeff(), 0.005);
}

TEST(Drape, InASeriesIsTheSameWhateverWasDrapedBefore) {
  const TightTube t;
  const Drape start{test::placed_nodes(t.pattern, t.mesh)};
  Drape lower = start;
  lower.nodes.col(1).array() -= 0.1;
  const DrapeResult alone = drape_from(t.pattern, t.mesh, t.body, start, {}, nullptr);
  DrapeSeries series(t.body);
  const DrapeResult first = series.drape_from(t.pattern, t.mesh, lower, {}, nullptr);
  EXPECT_NE(to_bytes(first), to_bytes(alone));
  EXPECT_EQ(to_bytes(series.drape_from(t.pattern, t.mesh, start, {}, nullptr)), to_bytes(alone));
}

TEST(Drape, GivenStartIsKeptWhenAsked) {
  const TightTube t;
  const Drape start = test::wrapped_tube(
      t.pattern, t.mesh, [](double) { return 0.15; }, 0.3);
  DrapeOptions options;
  options.keep_drape = true;
  const DrapeResult result = drape_from(t.pattern, t.mesh, t.body, start, options, nullptr);
  EXPECT_EQ((result.drape.nodes - start.nodes).norm(), 0);
  EXPECT_NEAR(result.quality.weft.p50, 0.15 / (0.96 * 0.14) - 1, 2e-3);
  EXPECT_EQ(result.quality.rest, Rest::AsGiven);
}

}  // namespace
}  // namespace toile
