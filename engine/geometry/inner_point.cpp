// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/inner_point.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/convex_hull.h"

namespace toile {

bool inside_polygon(const std::vector<Vec2>& polygon, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double distance_to_polygon(const std::vector<Vec2>& polygon, const Vec2& point) {
  double least = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double squared = (b - a).squaredNorm();
    const double t = squared > 0 ? std::clamp((point - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, (a + t * (b - a) - point).norm());
  }
  return least;
}

namespace {

// Middles of the chords across from every edge: a grid can miss a long narrow polygon.
void try_chord_middles(const std::vector<Vec2>& polygon, InnerPoint& best) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((b - a).squaredNorm() == 0.0) continue;
    const Vec2 along = (b - a).normalized(), across(-along.y(), along.x());
    for (const Vec2& way : {across, Vec2(-across)}) {
      const Vec2 start = 0.5 * (a + b) + 1e-3 * (b - a).norm() * way;
      if (!inside_polygon(polygon, start)) continue;
      const Vec2 middle = start + 0.5 * chord_through(polygon, start, way)[1] * way;
      const double clearance = distance_to_polygon(polygon, middle);
      if (clearance > best.clearance) best = {middle, clearance};
    }
  }
}

}  // namespace

InnerPoint roomiest_point(const std::vector<Vec2>& polygon) {
  InnerPoint best;
  if (polygon.empty()) return best;
  best.at = polygon[0];
  Vec2 low = polygon[0], high = polygon[0];
  for (const Vec2& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  try_chord_middles(polygon, best);
  // A coarse grid over the box, then finer ones round the best point so far.
  constexpr int kCells = 16;
  for (int round = 0; round < 3; ++round) {
    const Vec2 cell = (high - low) / kCells;
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        const Vec2 p = low + cell.cwiseProduct(Vec2(i + 0.5, j + 0.5));
        if (!inside_polygon(polygon, p)) continue;
        const double clearance = distance_to_polygon(polygon, p);
        if (clearance > best.clearance) best = {p, clearance};
      }
    low = best.at - 1.5 * cell, high = best.at + 1.5 * cell;
  }
  return best;
}

std::array<double, 2> chord_through(const std::vector<Vec2>& polygon, const Vec2& point, const Vec2& direction) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  double behind = -1e300, ahead = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - point, b = polygon[(i + 1) % polygon.size()] - point;
    const double side_a = cross(direction, a), side_b = cross(direction, b);
    if ((side_a <= 0) == (side_b <= 0)) continue;
    const double along = (a + side_a / (side_a - side_b) * (b - a)).dot(direction);
    along >= 0 ? ahead = std::min(ahead, along) : behind = std::max(behind, along);
  }
  if (behind == -1e300 || ahead == 1e300) return {0.0, 0.0};
  return {behind, ahead};
}

Vec2 least_box(const std::vector<Vec2>& outline) {
  const std::vector<Vec2> polygon = convex_hull(outline);
  Vec2 best = Vec2::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (edge.squaredNorm() == 0.0) continue;
    const Vec2 along = edge.normalized(), across(-along.y(), along.x());
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec2& p : polygon) {
      const Vec2 turned(p.dot(across), p.dot(along));
      low = low.cwiseMin(turned), high = high.cwiseMax(turned);
    }
    const Vec2 size = high - low;
    if (size.minCoeff() < best.x()) best = {size.minCoeff(), size.maxCoeff()};
  }
  return polygon.size() < 2 ? Vec2(0, 0) : best;
}

}  // namespace toile
