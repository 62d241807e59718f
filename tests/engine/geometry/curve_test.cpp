// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/curve.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/geometry/self_crossing.h"

namespace toile {
namespace {

constexpr double kExact = 1e-12;      // sums of a few rounded terms of size one
constexpr double kQuadrature = 1e-9;  // composite Gauss-Legendre on smooth curves

Curve line() {
  return {{0, 0}, {3, 4}, {}};
}

Curve quadratic() {
  Curve c{{0, 0}, {1, 0}, {}};
  c.shape.kind = CurveKind::QuadraticBezier;
  c.shape.control[0] = {0.5, 1.0};
  return c;
}

Curve cubic() {
  Curve c{{0, 0}, {2, 1}, {}};
  c.shape.kind = CurveKind::CubicBezier;
  c.shape.control = {Vec2(0.3, 1.2), Vec2(1.1, -0.7)};
  return c;
}

Curve arc(bool large, bool right) {
  Curve c{{1, 0}, {0, 1}, {}};
  c.shape.kind = CurveKind::Arc;
  c.shape.radius = 1.0;
  c.shape.large_arc = large;
  c.shape.bulges_right = right;
  return c;
}

Curve polyline() {
  Curve c{{0, 0}, {3, 0}, {}};
  c.shape.kind = CurveKind::Polyline;
  c.shape.points = {{1, 1}, {2, 1}};
  return c;
}

std::vector<Curve> all_curves() {
  return {line(),           quadratic(),      cubic(),         arc(false, false),
          arc(false, true), arc(true, false), arc(true, true), polyline()};
}

TEST(Curve, LengthsOfExactCases) {
  EXPECT_NEAR(curve_length(line()), 5.0, kExact);
  // y = 4 x (1 - x) * 1/2: closed form of a parabola's arc length.
  const double parabola = 0.5 * std::sqrt(5.0) + 0.25 * std::asinh(2.0);
  EXPECT_NEAR(curve_length(quadratic()), parabola, kQuadrature);
  EXPECT_NEAR(curve_length(arc(false, true)), std::numbers::pi / 2, kExact);
  EXPECT_NEAR(curve_length(arc(true, true)), 3 * std::numbers::pi / 2, kExact);
  EXPECT_NEAR(curve_length(polyline()), 1 + 2 * std::sqrt(2.0), kExact);
}

TEST(Curve, AnArcBulgingRightRunsCounterClockwise) {
  // From (1,0) to (0,1): the short arc round the origin runs counter-clockwise and bulges to the right of the chord.
  EXPECT_NEAR((arc_geometry(arc(false, true)).centre - Vec2(0, 0)).norm(), 0, kExact);
  EXPECT_NEAR((arc_geometry(arc(false, false)).centre - Vec2(1, 1)).norm(), 0, kExact);
  EXPECT_NEAR((arc_geometry(arc(true, false)).centre - Vec2(0, 0)).norm(), 0, kExact);
  EXPECT_NEAR((arc_geometry(arc(true, true)).centre - Vec2(1, 1)).norm(), 0, kExact);
  EXPECT_GT(arc_geometry(arc(false, true)).sweep, 0);
  EXPECT_LT(arc_geometry(arc(false, false)).sweep, 0);
}

TEST(Curve, EveryCurveEndsWhereItSaysAndSamplesEvenly) {
  for (const Curve& curve : all_curves()) {
    const auto points = sample_curve(curve, 7);
    ASSERT_EQ(points.size(), 8u);
    EXPECT_EQ(points.front(), curve.start);
    EXPECT_EQ(points.back(), curve.end);
    EXPECT_NEAR((curve_point(curve, 0) - curve.start).norm(), 0, kExact);
    EXPECT_NEAR((curve_point(curve, 1) - curve.end).norm(), 0, kExact);
  }
  // Even spacing on the unit circle: every chord has the same length.
  const auto points = sample_curve(arc(true, true), 9);
  for (std::size_t i = 1; i < points.size(); ++i)
    EXPECT_NEAR((points[i] - points[i - 1]).norm(), 2 * std::sin(std::numbers::pi / 12), kExact);
}

TEST(Curve, BezierSamplesLieAtEqualArcLength) {
  for (const Curve& curve : {quadratic(), cubic()}) {
    const int segments = 6, fine = 20000;
    const auto samples = sample_curve(curve, segments);
    double walked = 0.0;
    std::size_t next = 1;
    const double step = curve_length(curve) / segments;
    Vec2 last = curve.start;
    for (int i = 1; i <= fine && next < samples.size() - 1; ++i) {
      const Vec2 p = curve_point(curve, static_cast<double>(i) / fine);
      walked += (p - last).norm();
      last = p;
      if (walked < step * static_cast<double>(next)) continue;
      EXPECT_NEAR((p - samples[next]).norm(), 0, 2.0 * step * segments / fine * 2);
      ++next;
    }
    EXPECT_EQ(next, samples.size() - 1);
  }
}

TEST(Curve, DerivativeMatchesFiniteDifferences) {
  const double h = 1e-6;
  for (const Curve& curve : all_curves()) {
    const Vec2 numeric = (curve_point(curve, 0.37 + h) - curve_point(curve, 0.37 - h)) / (2 * h);
    EXPECT_NEAR((numeric - curve_derivative(curve, 0.37)).norm(), 0, 1e-7);
  }
}

TEST(Curve, ReversedCurveVisitsTheSamePointsBackwards) {
  for (const Curve& curve : all_curves()) {
    const Curve back = reversed(curve);
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0})
      EXPECT_NEAR((curve_point(curve, t) - curve_point(back, 1 - t)).norm(), 0, kExact);
    EXPECT_NEAR(curve_signed_area(curve), -curve_signed_area(back), kExact);
  }
}

TEST(Curve, SignedAreaOfAClosedOutline) {
  // Half disc: a half circle of radius 1 counter-clockwise about the origin and its diameter.
  Curve half{{1, 0}, {-1, 0}, {}};
  half.shape.kind = CurveKind::Arc;
  half.shape.radius = 0.5;  // clamped to half the chord
  half.shape.bulges_right = true;
  const Curve diameter{{-1, 0}, {1, 0}, {}};
  EXPECT_NEAR(curve_signed_area(half) + curve_signed_area(diameter), std::numbers::pi / 2, kExact);
  // Under a parabola of height 1/2 over [0, 1]: area 1/3, clockwise.
  EXPECT_NEAR(curve_signed_area(quadratic()) + curve_signed_area({{1, 0}, {0, 0}, {}}), -1.0 / 3.0, kExact);
}

TEST(Curve, FlattenedCurvesStayWithinTolerance) {
  const double tolerance = 1e-3;
  for (const Curve& curve : all_curves()) {
    const auto chords = flatten_curve(curve, tolerance);
    for (int i = 0; i <= 500; ++i) {
      const Vec2 p = curve_point(curve, i / 500.0);
      double nearest = 1e9;
      for (std::size_t k = 1; k < chords.size(); ++k) {
        const Vec2 d = chords[k] - chords[k - 1];
        const double t = std::clamp((p - chords[k - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - chords[k - 1] - t * d).norm());
      }
      EXPECT_LT(nearest, 1.2 * tolerance);
    }
  }
}

TEST(SelfCrossing, FindsCrossingsTouchesAndRunBacks) {
  const double tolerance = 1e-9;
  EXPECT_FALSE(find_self_crossing({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, tolerance));
  EXPECT_FALSE(find_self_crossing({{0, 0}, {2, 0}, {1, 0.01}}, tolerance));
  EXPECT_EQ(find_self_crossing({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, tolerance), std::pair(0, 2));
  EXPECT_TRUE(find_self_crossing({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, tolerance));  // a corner on an edge
  EXPECT_TRUE(find_self_crossing({{0, 0}, {2, 0}, {1, 0}, {1, 1}}, tolerance));          // runs back over itself
  EXPECT_TRUE(find_self_crossing({{0, 0}, {1, 0}, {1, 1}, {0.5, -1}, {0, 1}}, tolerance));
}

TEST(SelfCrossing, CountsItsComparisonsAndStopsWhenTheyAreUsedUp) {
  std::vector<Vec2> comb = {{0, -1}};  // teeth as high as the comb is wide: all overlap along the sweep
  for (int i = 0; i < 100; ++i) comb.emplace_back(0.01 * i, i % 2 ? 2.0 : 0.0);
  comb.emplace_back(1, -1);
  std::int64_t left = 1'000'000;
  EXPECT_FALSE(find_self_crossing(comb, 1e-9, &left));
  const std::int64_t used = 1'000'000 - left;
  EXPECT_GT(used, 100 * 99 / 4);
  EXPECT_LT(used, 102 * 101);
  left = used;
  EXPECT_FALSE(find_self_crossing(comb, 1e-9, &left));
  EXPECT_EQ(left, 0);
  left = used - 1;
  find_self_crossing(comb, 1e-9, &left);
  EXPECT_LT(left, 0);
}

TEST(Curve, IsFlattenedIntoNoMoreChordsThanAllowed) {
  Curve curve{{0, 0}, {1, 0}, {}};
  curve.shape.kind = CurveKind::CubicBezier;
  curve.shape.control = {Vec2(0.5, 900), Vec2(0.4, -900)};
  EXPECT_EQ(flatten_curve(curve, 1e-5).size(), 1u + kMostFlattenChords);
  const auto points = flatten_curve(curve, 1e-5, 40);
  ASSERT_EQ(points.size(), 41u);
  EXPECT_EQ(points.front(), curve.start);
  EXPECT_EQ(points.back(), curve.end);
  EXPECT_LT((points[20] - curve_point(curve, 0.5)).norm(), 1e-12);
}

}  // namespace
}  // namespace toile
