// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/fit_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace toile {

namespace {

constexpr int kFitRounds = 20;
constexpr double kGuessWeight = 1e-6;  // of the guess against one point, in the least squares over control points
// Of a point's offset along the curve, against the offset across it: the first converges fast, but may leave the points
// in a loop between two of them; the second is plain least squares.
constexpr std::array<double, 2> kSlideWeights = {0.01, 1.0};
constexpr double kDetour = 1.1;  // times the chord between two points: what a curve may walk between them
constexpr int kDetourChords = 4;
constexpr double kLeastReach = 0.2;  // of the chord: control points on a given direction are no nearer to their end
constexpr int kProjectionSteps = 8;
constexpr int kArcSteps = 60;

Vec2 second_derivative(const Curve& curve, double t) {
  const auto& c = curve.shape.control;
  if (curve.shape.kind == CurveKind::QuadraticBezier) return 2.0 * (curve.start - 2.0 * c[0] + curve.end);
  return 6.0 * (1.0 - t) * (curve.start - 2.0 * c[0] + c[1]) + 6.0 * t * (c[0] - 2.0 * c[1] + curve.end);
}

double project_on_bezier(const Curve& curve, const Vec2& point, double t) {
  double best = (curve_point(curve, t) - point).squaredNorm();
  for (int i = 0; i < kProjectionSteps; ++i) {
    const Vec2 offset = curve_point(curve, t) - point, speed = curve_derivative(curve, t);
    const double slope = offset.dot(speed);
    double curvature = speed.squaredNorm() + offset.dot(second_derivative(curve, t));
    if (curvature <= 0) curvature = speed.squaredNorm();
    if (curvature <= 0) break;
    double step = -slope / curvature;
    bool better = false;
    for (int halving = 0; halving < 6 && !better; ++halving, step *= 0.5) {
      const double next = std::clamp(t + step, 0.0, 1.0);
      const double distance = (curve_point(curve, next) - point).squaredNorm();
      if (distance < best) best = distance, t = next, better = true;
    }
    if (!better) break;
  }
  return t;
}

// Minimum of x^T normal x / 2 - right^T x over the two control points x of a cubic, each free or on a line through its
// end.
Eigen::Vector4d along_directions(const Curve& curve, const Eigen::Matrix4d& normal, const Eigen::Vector4d& right,
                                 const EndDirections& directions) {
  if (!directions.start && !directions.end) return normal.ldlt().solve(right);
  Eigen::Vector4d origin = Eigen::Vector4d::Zero();
  Eigen::MatrixXd ways = Eigen::MatrixXd::Zero(4, (directions.start ? 1 : 2) + (directions.end ? 1 : 2));
  const Eigen::Index last = ways.cols() - 1;
  if (directions.start) {
    origin.head<2>() = curve.start;
    ways.block<2, 1>(0, 0) = *directions.start;
  } else {
    ways.block<2, 2>(0, 0).setIdentity();
  }
  if (directions.end) {
    origin.tail<2>() = curve.end;
    ways.block<2, 1>(2, last) = -*directions.end;
  } else {
    ways.block<2, 2>(2, last - 1).setIdentity();
  }
  Eigen::VectorXd reach = (ways.transpose() * normal * ways).ldlt().solve(ways.transpose() * (right - normal * origin));
  const double least = kLeastReach * (curve.end - curve.start).norm();
  if (directions.start) reach[0] = std::max(reach[0], least);
  if (directions.end) reach[last] = std::max(reach[last], least);
  return origin + ways * reach;
}

// One linear least squares over the control points. Of the offset of each point from the curve the part along the curve
// counts little: the point may slide there, and the rounds converge as Gauss-Newton does [tangent distance
// minimisation].
void solve_control_points(Curve& curve, const std::vector<Vec2>& points, const std::vector<double>& parameters,
                          const EdgeCurve& guess, double slide_weight, const EndDirections& directions) {
  const bool cubic = curve.shape.kind == CurveKind::CubicBezier;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Identity() * kGuessWeight;
  Eigen::Vector4d right;
  right << kGuessWeight * guess.control[0], kGuessWeight * guess.control[1];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = parameters[i], r = 1.0 - t;
    const Vec2 weights = cubic ? Vec2(3 * r * r * t, 3 * r * t * t) : Vec2(2 * r * t, 0.0);
    const Vec2 fixed =
        cubic ? Vec2(r * r * r * curve.start + t * t * t * curve.end) : Vec2(r * r * curve.start + t * t * curve.end);
    const Vec2 along = curve_derivative(curve, t).normalized();
    const Mat2 metric = Mat2::Identity() - (1.0 - slide_weight) * along * along.transpose();
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k) normal.block<2, 2>(2 * j, 2 * k) += weights[j] * weights[k] * metric;
      right.segment<2>(2 * j) += weights[j] * (metric * (points[i] - fixed));
    }
  }
  const Eigen::Vector4d solution =
      cubic ? along_directions(curve, normal, right, directions) : Eigen::Vector4d(normal.ldlt().solve(right));
  curve.shape.control[0] = solution.head<2>();
  if (cubic) curve.shape.control[1] = solution.tail<2>();
}

// How far the curve strays between neighbouring points: half of what it walks more than it should.
double detour(const Curve& curve, const std::vector<Vec2>& points, const std::vector<double>& parameters) {
  double worst = 0.0;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const double from = i == 0 ? 0.0 : parameters[i - 1], to = i == points.size() ? 1.0 : parameters[i];
    const double chord = ((i == points.size() ? curve.end : points[i]) - (i == 0 ? curve.start : points[i - 1])).norm();
    double walked = to < from ? 2.0 * chord : 0.0;  // backwards
    Vec2 last = curve_point(curve, from);
    for (int k = 1; k <= kDetourChords; ++k) {
      const Vec2 next = curve_point(curve, from + (to - from) * k / kDetourChords);
      walked += (next - last).norm();
      last = next;
    }
    worst = std::max(worst, 0.5 * (walked - kDetour * chord));
  }
  return worst;
}

void fit_bezier_from(const Curve& guess, const std::vector<Vec2>& points, std::vector<double> parameters,
                     double slide_weight, const EndDirections& directions, CurveFit& best) {
  Curve curve = guess;
  for (int round = 0; round < kFitRounds; ++round) {
    solve_control_points(curve, points, parameters, guess.shape, slide_weight, directions);
    double deviation = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      parameters[i] = project_on_bezier(curve, points[i], parameters[i]);
      deviation = std::max(deviation, (curve_point(curve, parameters[i]) - points[i]).norm());
    }
    if (deviation >= best.deviation) continue;
    deviation = std::max(deviation, detour(curve, points, parameters));
    if (deviation < best.deviation) best = {curve, deviation};
  }
}

CurveFit fit_bezier(const Curve& guess, const std::vector<Vec2>& points, const std::vector<double>& parameters,
                    const EndDirections& directions) {
  CurveFit best{guess, 1e300};
  for (const double slide_weight : kSlideWeights)
    fit_bezier_from(guess, points, parameters, slide_weight, directions, best);
  return best;
}

// An arc over a given chord, by its signed height: positive bulges to the right of the way.
Curve arc_of_height(const Vec2& start, const Vec2& end, double height) {
  Curve arc{start, end, {}};
  const double half = 0.5 * (end - start).norm(), h = std::abs(height);
  arc.shape.kind = CurveKind::Arc;
  arc.shape.radius = std::max(half, 0.5 * (half * half / h + h));
  arc.shape.large_arc = h > half;
  arc.shape.bulges_right = height > 0;
  return arc;
}

double arc_height(const Curve& arc) {
  const ArcGeometry g = arc_geometry(arc);
  const double height = g.radius * (1.0 - std::cos(0.5 * std::abs(g.sweep)));
  return g.sweep > 0 ? height : -height;
}

double distance_to_arc(const ArcGeometry& arc, const Vec2& point) {
  return std::abs((point - arc.centre).norm() - arc.radius);
}

CurveFit fit_arc(const Curve& guess, const std::vector<Vec2>& points) {
  const double chord = (guess.end - guess.start).norm();
  const double first = arc_height(guess);
  if (points.empty() || std::abs(first) < 1e-9 * chord) return {guess, 0.0};
  const auto cost = [&](double height) {
    const ArcGeometry arc = arc_geometry(arc_of_height(guess.start, guess.end, height));
    double sum = 0.0;
    for (const Vec2& point : points) sum += std::pow(distance_to_arc(arc, point), 2);
    return sum;
  };
  // Golden section on the side the arc bulges to, between a third and three times the height.
  double low = first / 3.0, high = first * 3.0;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double cost_a = cost(a), cost_b = cost(b);
  for (int i = 0; i < kArcSteps; ++i) {
    if (cost_a < cost_b) {
      high = b, b = a, cost_b = cost_a, a = high - ratio * (high - low), cost_a = cost(a);
    } else {
      low = a, a = b, cost_a = cost_b, b = low + ratio * (high - low), cost_b = cost(b);
    }
  }
  CurveFit fit{arc_of_height(guess.start, guess.end, 0.5 * (low + high)), 0.0};
  const ArcGeometry arc = arc_geometry(fit.curve);
  for (const Vec2& point : points) fit.deviation = std::max(fit.deviation, distance_to_arc(arc, point));
  return fit;
}

CurveFit fit_line(const Curve& guess, const std::vector<Vec2>& points) {
  CurveFit fit{guess, 0.0};
  for (const Vec2& point : points) fit.deviation = std::max(fit.deviation, distance_to_curve(guess, point, 0.5).first);
  return fit;
}

}  // namespace

CurveFit fit_curve(const Curve& guess, const std::vector<Vec2>& points, const std::vector<double>& parameters,
                   const EndDirections& directions) {
  switch (guess.shape.kind) {
    case CurveKind::Line: return fit_line(guess, points);
    case CurveKind::Arc: return fit_arc(guess, points);
    case CurveKind::Polyline: {
      CurveFit fit{guess, 0.0};
      fit.curve.shape.points = points;
      return fit;
    }
    default: return fit_bezier(guess, points, parameters, directions);
  }
}

Curve carried(const Curve& curve, const Vec2& start, const Vec2& end) {
  const Vec2 from = curve.end - curve.start, to = end - start;
  // Complex quotient to / from: scale and turn in one.
  const double length_squared = from.squaredNorm();
  const double re = to.dot(from) / length_squared;
  const double im = (from.x() * to.y() - from.y() * to.x()) / length_squared;
  Mat2 similarity;
  similarity << re, -im, im, re;
  Curve result = curve;
  result.start = start;
  result.end = end;
  for (Vec2& control : result.shape.control) control = start + similarity * (control - curve.start);
  for (Vec2& point : result.shape.points) point = start + similarity * (point - curve.start);
  result.shape.radius *= std::hypot(re, im);
  return result;
}

Curve as_cubic(const Curve& curve) {
  Curve cubic{curve.start, curve.end, {}};
  cubic.shape.kind = CurveKind::CubicBezier;
  auto& control = cubic.shape.control;
  switch (curve.shape.kind) {
    case CurveKind::CubicBezier: control = curve.shape.control; break;
    case CurveKind::QuadraticBezier:
      control[0] = curve.start + 2.0 / 3.0 * (curve.shape.control[0] - curve.start);
      control[1] = curve.end + 2.0 / 3.0 * (curve.shape.control[0] - curve.end);
      break;
    case CurveKind::Arc: {
      // Hermite ends with the classic length 4/3 tan(sweep / 4) of the radius.
      const ArcGeometry arc = arc_geometry(curve);
      const double reach = 4.0 / 3.0 * std::tan(0.25 * arc.sweep);
      control[0] = curve.start + reach / arc.sweep * curve_derivative(curve, 0.0);
      control[1] = curve.end - reach / arc.sweep * curve_derivative(curve, 1.0);
      break;
    }
    default:
      control[0] = curve.start + (curve.end - curve.start) / 3.0;
      control[1] = curve.start + (curve.end - curve.start) * 2.0 / 3.0;
  }
  return cubic;
}

std::pair<double, double> distance_to_curve(const Curve& curve, const Vec2& point, double t) {
  switch (curve.shape.kind) {
    case CurveKind::Line: {
      const Vec2 way = curve.end - curve.start;
      t = std::clamp((point - curve.start).dot(way) / way.squaredNorm(), 0.0, 1.0);
      break;
    }
    case CurveKind::Arc: {
      const ArcGeometry arc = arc_geometry(curve);
      const Vec2 spoke = point - arc.centre;
      double turn = (std::atan2(spoke.y(), spoke.x()) - arc.start_angle) / arc.sweep;
      const double whole = 2.0 * std::numbers::pi / std::abs(arc.sweep);
      turn -= whole * std::floor(turn / whole);
      // Beyond the end: whichever end is nearer round the circle.
      t = turn <= 1.0 ? turn : (turn - 1.0 < whole - turn ? 1.0 : 0.0);
      break;
    }
    case CurveKind::Polyline: {
      double best = 1e300, walked = 0.0;
      const double length = curve_length(curve);
      std::vector<Vec2> corners = flatten_curve(curve, 1.0);
      for (std::size_t i = 1; i < corners.size(); ++i) {
        const Vec2 way = corners[i] - corners[i - 1];
        const double s =
            way.squaredNorm() > 0 ? std::clamp((point - corners[i - 1]).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
        const double distance = (corners[i - 1] + s * way - point).norm();
        if (distance < best) best = distance, t = (walked + s * way.norm()) / length;
        walked += way.norm();
      }
      return {best, t};
    }
    default: t = project_on_bezier(curve, point, t);
  }
  return {(curve_point(curve, t) - point).norm(), t};
}

}  // namespace toile
