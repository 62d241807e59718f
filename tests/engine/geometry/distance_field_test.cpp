// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/distance_field.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/spare_threads.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

constexpr double kFar = 1.0;

// Points at random within `depth` of the wall of a tube, away from its caps.
std::vector<Vec3> points_near_wall(double radius, double height, double depth, int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double r = radius + depth * (2 * unit(random) - 1), y = height * (0.2 + 0.6 * unit(random));
    const double angle = 2 * M_PI * unit(random);
    points.emplace_back(r * std::sin(angle), y, r * std::cos(angle));
  }
  return points;
}

void expect_gradient(SignedField& field, const Vec3& p, double tolerance) {
  Vec3 gradient, ignored;
  field.evaluate(p, kFar, gradient);
  ASSERT_GT(gradient.norm(), 0.5);
  for (int d = 0; d < 3; ++d) {
    const Vec3 step = 1e-6 * Vec3::Unit(d);
    const double slope = (field.evaluate(p + step, kFar, ignored) - field.evaluate(p - step, kFar, ignored)) / 2e-6;
    ASSERT_NEAR(slope, gradient[d], tolerance);
  }
}

TEST(SurfaceField, AskingAgainWithAMemoryGivesTheSameAnswer) {
  const Body tube = test::tube_body("tube", 0.14, 1.0);
  SurfaceField field(tube.surface.vertices, tube.surface.triangles),
      plain(tube.surface.vertices, tube.surface.triangles);
  std::int32_t hint = 0;
  Vec3 gradient = Vec3::Zero(), expected = Vec3::Zero();
  for (const Vec3& p : points_near_wall(0.14, 1.0, 0.01, 300)) {
    ASSERT_EQ(field.evaluate_again(p, kFar, gradient, hint), plain.evaluate(p, kFar, expected));
    ASSERT_EQ(gradient, expected);
    field.prepare(hint);
    ASSERT_EQ(field.evaluate_again(p, kFar, gradient, hint), plain.evaluate(p, kFar, expected));
  }
}

TEST(DistanceField, AnalyticFieldsHaveTheirOwnGradients) {
  CylinderField cylinder(0.14);
  BellyField belly(0.13, 0.04, 0.3, 0.08);
  for (const Vec3& p : points_near_wall(0.15, 0.6, 0.05, 50)) {
    expect_gradient(cylinder, p, 1e-8);
    expect_gradient(belly, p, 1e-8);
  }
}

TEST(DistanceField, SurfaceFieldIsCloseToTheExactDistanceOnBothSides) {
  const double radius = 0.05;
  const Body body = test::tube_body("tube", radius, 0.5, 200, 40);
  SurfaceField field(body.surface.vertices, body.surface.triangles);
  Vec3 gradient;
  for (const Vec3& p : points_near_wall(radius, 0.5, 0.015, 2000)) {
    const double exact = std::hypot(p.x(), p.z()) - radius;
    // A quadratic B-spline of spacing h lies h^2 / (8 r) above a distance of curvature 1 / r.
    ASSERT_NEAR(field.evaluate(p, kFar, gradient), exact, 0.3e-3);
    ASSERT_NEAR(gradient.norm(), 1, 0.02);
    ASSERT_GT(gradient.dot(Vec3(p.x(), 0, p.z()).normalized()), 0.995);
  }
}

TEST(DistanceField, GradientIsTheDerivativeAcrossLatticeCells) {
  const Body body = test::tube_body("tube", 0.05, 0.5, 200, 40);
  SurfaceField field(body.surface.vertices, body.surface.triangles);
  for (const Vec3& p : points_near_wall(0.05, 0.5, 0.015, 200)) expect_gradient(field, p, 1e-4);
}

TEST(DistanceField, TouchingAndOverlappingPartsAreInside) {
  const Body left = test::tube_body("left", 0.05, 0.5), right = test::tube_body("right", 0.05, 0.5);
  TriangleMesh both;
  const int n = left.surface.vertex_count();
  both.vertices.resize(2 * n, 3);
  both.vertices << left.surface.vertices, (right.surface.vertices.rowwise() + Eigen::RowVector3d(0.09, 0, 0));
  both.triangles.resize(2 * left.surface.triangle_count(), 3);
  both.triangles << left.surface.triangles, (right.surface.triangles.array() + n).matrix();
  SurfaceField field(both.vertices, both.triangles);
  Vec3 gradient;
  for (double x : {0.0, 0.02, 0.045, 0.07, 0.09}) EXPECT_LT(field.evaluate({x, 0.25, 0}, kFar, gradient), 0) << x;
  EXPECT_GT(field.evaluate({0.045, 0.25, 0.04}, kFar, gradient), 0);
}

TEST(DistanceField, IsFilledOnlyWhereItIsVisitedAndNotWhereNothingIsNear) {
  const Body body = test::tube_body("tube", 0.15, 1.5);
  SurfaceField field(body.surface.vertices, body.surface.triangles);
  EXPECT_EQ(field.lattice_nodes_computed(), 0);
  Vec3 gradient;
  EXPECT_GT(field.evaluate({0.5, 0.5, 0.5}, 0.01, gradient), 0.01);
  EXPECT_EQ(field.lattice_nodes_computed(), 0);
  field.evaluate({0.151, 0.5, 0}, 0.01, gradient);
  EXPECT_GT(field.lattice_nodes_computed(), 0);
  EXPECT_LT(field.lattice_nodes_computed(), 28);
}

TEST(DistanceField, LookingAheadFillsJustWhatIsVisitedAndTheSameWithAnIdleThread) {
  const Body body = test::tube_body("tube", 0.05, 0.5, 200, 40);
  const std::vector<Vec3> list = points_near_wall(0.05, 0.5, 0.015, 500);
  Points3 points(static_cast<Eigen::Index>(list.size()), 3);
  for (std::size_t i = 0; i < list.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = list[i].transpose();
  constexpr double kReach = 0.005;
  SurfaceField visited(body.surface.vertices, body.surface.triangles),
      ahead(body.surface.vertices, body.surface.triangles), shared(body.surface.vertices, body.surface.triangles);
  ahead.look_ahead(points, kReach);
  const int computed = ahead.lattice_nodes_computed();
  ASSERT_GT(computed, 500);
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  shared.look_ahead(points, kReach);
  for (const Vec3& p : list) {
    Vec3 gradient, other;
    const double distance = visited.evaluate(p, kReach, gradient), known = ahead.evaluate(p, kReach, other);
    ASSERT_EQ(distance, known);
    ASSERT_EQ(known, shared.evaluate(p, kReach, other));
  }
  EXPECT_EQ(ahead.lattice_nodes_computed(), computed);
  EXPECT_EQ(visited.lattice_nodes_computed(), computed);
}

TEST(DistanceField, ValuesDoNotDependOnTheOrderOfVisits) {
  const Body body = test::tube_body("tube", 0.05, 0.5);
  SurfaceField forward(body.surface.vertices, body.surface.triangles),
      back(body.surface.vertices, body.surface.triangles);
  const std::vector<Vec3> points = points_near_wall(0.05, 0.5, 0.02, 300);
  Vec3 gradient;
  std::vector<double> values;
  for (const Vec3& p : points) values.push_back(forward.evaluate(p, kFar, gradient));
  for (std::size_t i = points.size(); i-- > 0;) ASSERT_EQ(back.evaluate(points[i], kFar, gradient), values[i]);
}

TEST(DistanceField, RefusesABodyInTheWrongUnit) {
  Body body = test::tube_body("tube", 0.05, 0.5);
  body.surface.vertices *= 1000;
  EXPECT_THROW(SurfaceField(body.surface.vertices, body.surface.triangles), Error);
}

}  // namespace
}  // namespace toile
