// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/geometry/flat_vectors.h"

namespace toile {

namespace {

constexpr int kLengthIntervals = 16;  // Gauss-Legendre intervals a Bézier is cut into
constexpr int kFlattenProbe = 16;     // chords that the deviation of a Bézier is first measured with

// Abscissae and weights of 8-point Gauss-Legendre quadrature on [-1, 1] (Abramowitz & Stegun, table 25.4).
constexpr std::array<double, 4> kGaussX = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363};
constexpr std::array<double, 4> kGaussW = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};

bool is_bezier(CurveKind kind) {
  return kind == CurveKind::QuadraticBezier || kind == CurveKind::CubicBezier;
}

template <class Function>
double integrate(double from, double to, const Function& f) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGaussX.size(); ++i)
    sum += kGaussW[i] * (f(middle - half * kGaussX[i]) + f(middle + half * kGaussX[i]));
  return sum * half;
}

double speed_integral(const Curve& curve, double from, double to) {
  return integrate(from, to, [&](double t) { return curve_derivative(curve, t).norm(); });
}

// Arc length from the start to each of kLengthIntervals + 1 evenly spaced parameters.
std::vector<double> length_table(const Curve& curve) {
  std::vector<double> table = {0.0};
  for (int i = 0; i < kLengthIntervals; ++i)
    table.push_back(table.back() + speed_integral(curve, static_cast<double>(i) / kLengthIntervals,
                                                  static_cast<double>(i + 1) / kLengthIntervals));
  return table;
}

// Parameter of a Bézier at arc length `s`: safeguarded Newton inside the table's interval.
double parameter_at_length(const Curve& curve, const std::vector<double>& table, double s) {
  const auto above = std::upper_bound(table.begin(), table.end() - 1, s);
  const auto interval = std::max<std::ptrdiff_t>(above - table.begin() - 1, 0);
  double low = static_cast<double>(interval) / kLengthIntervals;
  double high = static_cast<double>(interval + 1) / kLengthIntervals;
  const double base = low, target = s - table[static_cast<std::size_t>(interval)];
  double t = 0.5 * (low + high);
  for (int i = 0; i < 60; ++i) {
    const double excess = speed_integral(curve, base, t) - target;
    (excess > 0 ? high : low) = t;
    if (std::abs(excess) <= 1e-14 * table.back() || high - low < 1e-16) break;
    const double speed = curve_derivative(curve, t).norm();
    const double step = speed > 0 ? t - excess / speed : low - 1;
    t = step > low && step < high ? step : 0.5 * (low + high);
  }
  return t;
}

std::vector<Vec2> polyline_corners(const Curve& curve) {
  std::vector<Vec2> corners = {curve.start};
  corners.insert(corners.end(), curve.shape.points.begin(), curve.shape.points.end());
  corners.push_back(curve.end);
  return corners;
}

double polyline_length(const std::vector<Vec2>& corners) {
  double length = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += (corners[i] - corners[i - 1]).norm();
  return length;
}

// The piece of a polyline at fraction t of its length, and the fraction of that piece.
std::pair<std::size_t, double> polyline_piece(const std::vector<Vec2>& corners, double t) {
  double left = t * polyline_length(corners);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double piece = (corners[i] - corners[i - 1]).norm();
    if ((left <= piece && piece > 0) || i + 1 == corners.size())
      return {i, piece > 0 ? std::clamp(left / piece, 0.0, 1.0) : 0.0};
    left -= piece;
  }
  return {1, 0.0};
}

Vec2 polyline_point(const Curve& curve, double t) {
  const auto corners = polyline_corners(curve);
  const auto [i, s] = polyline_piece(corners, t);
  return corners[i - 1] + s * (corners[i] - corners[i - 1]);
}

Vec2 arc_point(const ArcGeometry& arc, double t) {
  const double angle = arc.start_angle + t * arc.sweep;
  return arc.centre + arc.radius * Vec2(std::cos(angle), std::sin(angle));
}

int chords_for_tolerance(const Curve& curve, double tolerance, int most) {
  if (curve.shape.kind == CurveKind::Arc) {
    const ArcGeometry arc = arc_geometry(curve);
    const double step = 2.0 * std::acos(std::clamp(1.0 - tolerance / arc.radius, -1.0, 1.0));
    return step > 0 ? static_cast<int>(std::ceil(std::min(std::abs(arc.sweep) / step, 1.0 * most))) : 1;
  }
  double sag = 0.0;
  for (int i = 0; i < kFlattenProbe; ++i) {
    const double t0 = static_cast<double>(i) / kFlattenProbe, t1 = static_cast<double>(i + 1) / kFlattenProbe;
    const Vec2 chord_middle = 0.5 * (curve_point(curve, t0) + curve_point(curve, t1));
    sag = std::max(sag, (curve_point(curve, 0.5 * (t0 + t1)) - chord_middle).norm());
  }
  // The sag of a chord falls with the square of their number.
  return static_cast<int>(std::ceil(std::min(kFlattenProbe * std::sqrt(sag / tolerance), 1.0 * most)));
}

}  // namespace

Curve edge_curve(const Panel& panel, int edge) {
  return {panel.edge_start(edge), panel.edge_end(edge), panel.edges[static_cast<std::size_t>(edge)].curve};
}

ArcGeometry arc_geometry(const Curve& curve) {
  const Vec2 chord = curve.end - curve.start;
  const double length = chord.norm();
  ArcGeometry arc;
  arc.radius = std::max(curve.shape.radius, 0.5 * length);
  const double height = std::sqrt(std::max(0.0, arc.radius * arc.radius - 0.25 * length * length));
  const Vec2 left(-chord.y() / length, chord.x() / length);
  const double sign = curve.shape.bulges_right != curve.shape.large_arc ? 1.0 : -1.0;
  arc.centre = 0.5 * (curve.start + curve.end) + sign * height * left;
  const double half_angle = std::asin(std::min(1.0, 0.5 * length / arc.radius));
  const double sweep = curve.shape.large_arc ? 2.0 * (std::numbers::pi - half_angle) : 2.0 * half_angle;
  arc.sweep = curve.shape.bulges_right ? sweep : -sweep;
  const Vec2 spoke = curve.start - arc.centre;
  arc.start_angle = std::atan2(spoke.y(), spoke.x());
  return arc;
}

Vec2 curve_point(const Curve& curve, double t) {
  const double r = 1.0 - t;
  const auto& c = curve.shape.control;
  switch (curve.shape.kind) {
    case CurveKind::Line: return r * curve.start + t * curve.end;
    case CurveKind::QuadraticBezier: return r * r * curve.start + 2 * r * t * c[0] + t * t * curve.end;
    case CurveKind::CubicBezier:
      return r * r * r * curve.start + 3 * r * r * t * c[0] + 3 * r * t * t * c[1] + t * t * t * curve.end;
    case CurveKind::Arc: return arc_point(arc_geometry(curve), t);
    case CurveKind::Polyline: return polyline_point(curve, t);
  }
  return curve.start;
}

Vec2 curve_derivative(const Curve& curve, double t) {
  const double r = 1.0 - t;
  const auto& c = curve.shape.control;
  switch (curve.shape.kind) {
    case CurveKind::Line: return curve.end - curve.start;
    case CurveKind::QuadraticBezier: return 2 * r * (c[0] - curve.start) + 2 * t * (curve.end - c[0]);
    case CurveKind::CubicBezier:
      return 3 * r * r * (c[0] - curve.start) + 6 * r * t * (c[1] - c[0]) + 3 * t * t * (curve.end - c[1]);
    case CurveKind::Arc: {
      const ArcGeometry arc = arc_geometry(curve);
      const double angle = arc.start_angle + t * arc.sweep;
      return arc.sweep * arc.radius * Vec2(-std::sin(angle), std::cos(angle));
    }
    case CurveKind::Polyline: {
      const auto corners = polyline_corners(curve);
      const std::size_t i = polyline_piece(corners, t).first;
      return polyline_length(corners) * (corners[i] - corners[i - 1]).normalized();
    }
  }
  return Vec2::Zero();
}

double curve_length(const Curve& curve) {
  switch (curve.shape.kind) {
    case CurveKind::Line: return (curve.end - curve.start).norm();
    case CurveKind::Arc: {
      const ArcGeometry arc = arc_geometry(curve);
      return arc.radius * std::abs(arc.sweep);
    }
    case CurveKind::Polyline: return polyline_length(polyline_corners(curve));
    default: return length_table(curve).back();
  }
}

std::vector<double> curve_parameters_at(const Curve& curve, const std::vector<double>& fractions) {
  if (!is_bezier(curve.shape.kind)) return fractions;
  const std::vector<double> table = length_table(curve);
  std::vector<double> parameters;
  for (const double fraction : fractions)
    parameters.push_back(fraction <= 0.0   ? 0.0
                         : fraction >= 1.0 ? 1.0
                                           : parameter_at_length(curve, table, fraction * table.back()));
  return parameters;
}

std::vector<Vec2> curve_points_at(const Curve& curve, const std::vector<double>& fractions) {
  std::vector<Vec2> points;
  points.reserve(fractions.size());
  for (const double t : curve_parameters_at(curve, fractions))
    points.push_back(t <= 0.0 ? curve.start : t >= 1.0 ? curve.end : curve_point(curve, t));
  return points;
}

std::vector<Vec2> sample_curve(const Curve& curve, int segments) {
  std::vector<double> fractions;
  for (int i = 0; i <= segments; ++i) fractions.push_back(static_cast<double>(i) / segments);
  return curve_points_at(curve, fractions);
}

std::vector<Vec2> flatten_curve(const Curve& curve, double tolerance, int most_chords) {
  if (curve.shape.kind == CurveKind::Line) return {curve.start, curve.end};
  if (curve.shape.kind == CurveKind::Polyline) return polyline_corners(curve);
  const int chords = std::max(1, chords_for_tolerance(curve, tolerance, most_chords));
  std::vector<Vec2> points = {curve.start};
  for (int i = 1; i < chords; ++i) points.push_back(curve_point(curve, static_cast<double>(i) / chords));
  points.push_back(curve.end);
  return points;
}

double curve_signed_area(const Curve& curve) {
  switch (curve.shape.kind) {
    case CurveKind::Line: return 0.5 * cross(curve.start, curve.end);
    case CurveKind::Arc: {
      const ArcGeometry arc = arc_geometry(curve);
      return 0.5 * (arc.radius * arc.radius * arc.sweep + cross(arc.centre, curve.end - curve.start));
    }
    case CurveKind::Polyline: {
      const auto corners = polyline_corners(curve);
      double area = 0.0;
      for (std::size_t i = 1; i < corners.size(); ++i) area += 0.5 * cross(corners[i - 1], corners[i]);
      return area;
    }
    default:  // the integrand of a Bézier is a polynomial of degree 5 at most: the quadrature is exact
      return 0.5 *
             integrate(0.0, 1.0, [&](double t) { return cross(curve_point(curve, t), curve_derivative(curve, t)); });
  }
}

Curve reversed(const Curve& curve) {
  Curve back = curve;
  std::swap(back.start, back.end);
  if (curve.shape.kind == CurveKind::CubicBezier) std::swap(back.shape.control[0], back.shape.control[1]);
  back.shape.bulges_right = !curve.shape.bulges_right;
  std::reverse(back.shape.points.begin(), back.shape.points.end());
  return back;
}

double edge_length(const Panel& panel, int edge) {
  return curve_length(edge_curve(panel, edge));
}

double outline_signed_area(const Panel& panel) {
  double area = 0.0;
  for (int e = 0; e < panel.edge_count(); ++e) area += curve_signed_area(edge_curve(panel, e));
  return area;
}

std::vector<Vec2> flatten_outline(const Panel& panel, double tolerance) {
  std::vector<Vec2> polygon;
  for (int e = 0; e < panel.edge_count(); ++e) {
    const auto points = flatten_curve(edge_curve(panel, e), tolerance);
    polygon.insert(polygon.end(), points.begin(), points.end() - 1);
  }
  return polygon;
}

}  // namespace toile
