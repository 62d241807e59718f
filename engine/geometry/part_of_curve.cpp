// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/part_of_curve.h"

#include <algorithm>
#include <numbers>

#include "engine/geometry/fit_curve.h"

namespace toile {
namespace {

constexpr int kStarts = 16;  // places along a curve from which the nearest one is refined

Curve line_part(const Curve& curve, double from, double to) {
  return {curve_point(curve, from), curve_point(curve, to), curve.shape};
}

// Blossoms of the Bézier at (from, from, to) and so on are the part's control points.
Curve cubic_part(const Curve& curve, double from, double to) {
  const std::array<Vec2, 4> p = {curve.start, curve.shape.control[0], curve.shape.control[1], curve.end};
  const auto blossom = [&p](double a, double b, double c) -> Vec2 {
    std::array<Vec2, 4> q = p;
    int last = 3;
    for (const double t : {a, b, c}) {
      for (int i = 0; i < last; ++i) {
        const auto k = static_cast<std::size_t>(i);
        q[k] = (1 - t) * q[k] + t * q[k + 1];
      }
      --last;
    }
    return q[0];
  };
  Curve part{blossom(from, from, from), blossom(to, to, to), curve.shape};
  part.shape.control = {blossom(from, from, to), blossom(from, to, to)};
  return part;
}

Curve quadratic_part(const Curve& curve, double from, double to) {
  const Vec2 &a = curve.start, &b = curve.shape.control[0], &c = curve.end;
  const auto blossom = [&](double s, double t) -> Vec2 {
    return (1 - s) * (1 - t) * a + (s * (1 - t) + t * (1 - s)) * b + s * t * c;
  };
  Curve part{blossom(from, from), blossom(to, to), curve.shape};
  part.shape.control[0] = blossom(from, to);
  return part;
}

Curve arc_part(const Curve& curve, double from, double to) {
  const ArcGeometry arc = arc_geometry(curve);
  Curve part = line_part(curve, from, to);
  part.shape.radius = arc.radius;
  part.shape.large_arc = std::abs(arc.sweep) * (to - from) > std::numbers::pi;
  return part;
}

Curve polyline_part(const Curve& curve, double from, double to) {
  Curve part = line_part(curve, from, to);
  part.shape.points.clear();
  const double length = curve_length(curve);
  double walked = 0.0;
  Vec2 last = curve.start;
  for (const Vec2& p : curve.shape.points) {
    walked += (p - last).norm();
    last = p;
    const double t = walked / length;
    if (t > from + 1e-9 && t < to - 1e-9) part.shape.points.push_back(p);
  }
  if (part.shape.points.empty()) part.shape.kind = CurveKind::Line;
  return part;
}

}  // namespace

CurvePlace nearest_on_curve(const Curve& curve, const Vec2& point) {
  double start = 0.0, least = 1e300;
  for (int i = 0; i <= kStarts; ++i) {
    const double t = static_cast<double>(i) / kStarts;
    const double distance = (curve_point(curve, t) - point).squaredNorm();
    if (distance < least) least = distance, start = t;
  }
  const auto [distance, t] = distance_to_curve(curve, point, start);
  return {t, distance};
}

Curve part_of_curve(const Curve& curve, double from, double to) {
  Curve part = curve;
  if (from <= 0.0 && to >= 1.0) return part;
  switch (curve.shape.kind) {
    case CurveKind::Line: part = line_part(curve, from, to); break;
    case CurveKind::QuadraticBezier: part = quadratic_part(curve, from, to); break;
    case CurveKind::CubicBezier: part = cubic_part(curve, from, to); break;
    case CurveKind::Arc: part = arc_part(curve, from, to); break;
    case CurveKind::Polyline: part = polyline_part(curve, from, to); break;
  }
  if (from <= 0.0) part.start = curve.start;
  if (to >= 1.0) part.end = curve.end;
  return part;
}

}  // namespace toile
