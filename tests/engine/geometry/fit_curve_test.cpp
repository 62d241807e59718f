// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/fit_curve.h"

#include <cmath>

#include <gtest/gtest.h>

namespace toile {
namespace {

Curve curve_of(CurveKind kind) {
  Curve c{{0, 0}, {0.3, 0.1}, {}};
  c.shape.kind = kind;
  c.shape.control = {Vec2(0.1, 0.15), Vec2(0.25, -0.05)};
  c.shape.radius = 0.2;
  c.shape.bulges_right = true;
  if (kind == CurveKind::Polyline) c.shape.points = {{0.1, 0.05}, {0.2, 0.02}};
  return c;
}

const CurveKind kKinds[] = {CurveKind::Line, CurveKind::QuadraticBezier, CurveKind::CubicBezier, CurveKind::Arc};

std::vector<Vec2> inner_samples(const Curve& curve, int segments) {
  std::vector<Vec2> points = sample_curve(curve, segments);
  return {points.begin() + 1, points.end() - 1};
}

std::vector<double> even_parameters(int segments) {
  std::vector<double> t;
  for (int i = 1; i < segments; ++i) t.push_back(static_cast<double>(i) / segments);
  return t;
}

TEST(FitCurve, FindsTheCurveItsSamplesWereTakenFrom) {
  constexpr double kTolerance = 2e-6;  // m; 20 rounds of projection and least squares
  for (const CurveKind kind : kKinds) {
    const Curve truth = curve_of(kind);
    Curve guess = truth;
    guess.shape.control[0] += Vec2(0.02, -0.03);
    guess.shape.radius *= 1.3;
    const CurveFit fit = fit_curve(guess, inner_samples(truth, 12), even_parameters(12));
    EXPECT_EQ(fit.curve.shape.kind, kind);
    EXPECT_LT(fit.deviation, 20 * kTolerance);
    for (const Vec2& p : inner_samples(truth, 30)) EXPECT_LT(distance_to_curve(fit.curve, p, 0.5).first, 1e-4);
  }
}

TEST(FitCurve, TooFewPointsKeepTheGuess) {
  for (const CurveKind kind : kKinds) {
    const Curve guess = curve_of(kind);
    const CurveFit fit = fit_curve(guess, {}, {});
    for (const double t : {0.2, 0.6}) EXPECT_LT((curve_point(fit.curve, t) - curve_point(guess, t)).norm(), 1e-12);
  }
}

TEST(FitCurve, CarriedCurvesKeepTheirShape) {
  const Vec2 start(1, 2), end(1.2, 2.9);
  for (const CurveKind kind :
       {CurveKind::Line, CurveKind::QuadraticBezier, CurveKind::CubicBezier, CurveKind::Arc, CurveKind::Polyline}) {
    const Curve before = curve_of(kind), after = carried(before, start, end);
    const double scale = (end - start).norm() / (before.end - before.start).norm();
    EXPECT_NEAR(curve_length(after), scale * curve_length(before), 1e-9);
    const Curve back = carried(after, before.start, before.end);
    for (const double t : {0.3, 0.8}) EXPECT_LT((curve_point(back, t) - curve_point(before, t)).norm(), 1e-12);
  }
}

TEST(FitCurve, CubicsStandInForEveryOtherKind) {
  for (const CurveKind kind : kKinds) {
    const Curve before = curve_of(kind);
    const Curve cubic = as_cubic(before);
    for (int i = 0; i <= 20; ++i)
      EXPECT_LT(distance_to_curve(before, curve_point(cubic, i / 20.0), i / 20.0).first, 1e-3 * before.shape.radius);
  }
}

TEST(FitCurve, DistanceToAnArcIsThatOfItsNearestPoint) {
  const Curve arc = curve_of(CurveKind::Arc);
  for (const Vec2& p : {Vec2(0.1, -0.2), Vec2(-0.3, 0), Vec2(0.6, 0.4), Vec2(0.15, 0.3)}) {
    double nearest = 1e9;
    for (int i = 0; i <= 4000; ++i) nearest = std::min(nearest, (curve_point(arc, i / 4000.0) - p).norm());
    EXPECT_NEAR(distance_to_curve(arc, p, 0.5).first, nearest, 1e-6);
  }
}

}  // namespace
}  // namespace toile
