// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/catmull_clark.h"

#include <set>

#include <gtest/gtest.h>

namespace toile {
namespace {

constexpr double kRounding = 1e-12;

Points3 cube_points() {
  Points3 points(8, 3);
  for (int i = 0; i < 8; ++i) points.row(i) << (i & 1 ? 1 : -1), (i & 2 ? 1 : -1), (i & 4 ? 1 : -1);
  return points;
}

Quads cube_quads() {
  Quads quads(6, 4);
  quads << 0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5;
  return quads;
}

void expect_closed(const Quads& quads) {
  std::set<std::pair<int, int>> directed;
  for (int q = 0; q < quads.rows(); ++q)
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(directed.insert({quads(q, k), quads(q, (k + 1) % 4)}).second);
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
}

TEST(CatmullClark, RefinesACubeIntoAClosedMeshOfFourTimesTheQuads) {
  const RefinedQuads fine = refine_catmull_clark(cube_quads(), 8);
  EXPECT_EQ(fine.quads.rows(), 24);
  EXPECT_EQ(fine.points.rows(), 8 + 12 + 6);
  expect_closed(cube_quads());
  expect_closed(fine.quads);
}

TEST(CatmullClark, EveryStencilSumsToOne) {
  const RefinedQuads fine = refine_catmull_clark(cube_quads(), 8);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(8);
  EXPECT_LT(((fine.points * ones).array() - 1.0).abs().maxCoeff(), kRounding);
  EXPECT_LT(((catmull_clark_limit(cube_quads(), 8) * ones).array() - 1.0).abs().maxCoeff(), kRounding);
}

TEST(CatmullClark, RefinedCornerOfACubeIsTheTextbookValue) {
  const RefinedQuads fine = refine_catmull_clark(cube_quads(), 8);
  const Points3 points = fine.points * cube_points();
  // Corner (1,1,1): faces average 1/3 each, edge middles 2/3: (1/3 + 2 * 2/3 + 0) / 3 = 5/9.
  EXPECT_LT((points.row(7).transpose() - Vec3::Constant(5.0 / 9.0)).norm(), kRounding);
}

TEST(CatmullClark, LimitPositionIsWhereRefinementConverges) {
  const Points3 limit = catmull_clark_limit(cube_quads(), 8) * cube_points();
  Points3 points = cube_points();
  Quads quads = cube_quads();
  for (int level = 0; level < 6; ++level) {
    const RefinedQuads fine = refine_catmull_clark(quads, static_cast<int>(points.rows()));
    points = fine.points * points;
    quads = fine.quads;
  }
  constexpr double kSixLevels = 5e-4;  // what is left of the corner's way after six refinements
  EXPECT_LT((points.topRows(8) - limit).cwiseAbs().maxCoeff(), kSixLevels);
  EXPECT_LT(limit.row(7).norm(), cube_points().row(7).norm() * 0.6);
}

TEST(CatmullClark, ControlPointsAreFoundWhoseLimitPassesThroughTheWantedPoints) {
  const PointStencils limit = catmull_clark_limit(cube_quads(), 8);
  const Points3 control = interpolating_control_points(limit, cube_points(), 200);
  EXPECT_LT((limit * control - cube_points()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(control.cwiseAbs().maxCoeff(), 1.5);  // the cage stands out over the surface
}

}  // namespace
}  // namespace toile
