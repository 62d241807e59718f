// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/offset_polygon.h"

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/geometry/flat_vectors.h"
#include "engine/geometry/positive_outline.h"

namespace toile {
namespace {

// One segment of the outline with the line it moves to.
struct Grown {
  Vec2 start, end;  // moved
  Vec2 direction;   // unit
  double distance = 0.0, length = 0.0;
};

std::vector<Grown> grow_segments(const std::vector<Vec2>& polygon, const std::vector<double>& distances) {
  std::vector<Grown> grown;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double length = (b - a).norm();
    if (length <= 0) continue;
    const Vec2 direction = (b - a) / length;
    const Vec2 outward(direction.y(), -direction.x());
    grown.push_back({a + distances[i] * outward, b + distances[i] * outward, direction, distances[i], length});
  }
  return grown;
}

// Where the lines of two grown segments cross; requires that they are not parallel.
Vec2 crossing(const Grown& a, const Grown& b) {
  const double t = cross(b.start - a.start, b.direction) / cross(a.direction, b.direction);
  return a.start + t * a.direction;
}

// Corners of the raw curve: crossing lines, a square tip where they meet too far off, and the corner itself where the
// outline is hollow and a segment is too short to be trimmed.
class RawOffset {
 public:
  explicit RawOffset(double mitre_limit) : mitre_limit_(mitre_limit) {}

  void join(const Grown& before, const Grown& after, const Vec2& corner) {
    const double turn = cross(before.direction, after.direction), along = before.direction.dot(after.direction);
    constexpr double kParallel = 1e-3;  // sine below which lines are taken as parallel
    if (std::abs(turn) < kParallel && along > 0) return join_parallel(before, after);
    if (turn > 0) return join_convex(before, after, corner);
    join_hollow(before, after, corner);
  }
  std::vector<Vec2> points;

 private:
  void join_parallel(const Grown& before, const Grown& after) {
    points.push_back(before.end);
    if (before.distance != after.distance) points.push_back(after.start);
  }

  void join_convex(const Grown& before, const Grown& after, const Vec2& corner) {
    const Vec2 tip = crossing(before, after);
    // Where the distance changes at a slight bend the lines cross beside the corner, not beyond it: a step.
    if ((tip - before.end).dot(before.direction) < -1e-9 || (tip - after.start).dot(after.direction) > 1e-9) {
      points.push_back(before.end);
      points.push_back(after.start);
      return;
    }
    const double reach = mitre_limit_ * std::max(before.distance, after.distance);
    const double length = (tip - corner).norm();
    if (length <= reach || reach <= 0) return points.push_back(tip);
    // Both lines are cut where they are `reach` away from the corner along the mitre.
    const Vec2 mitre = (tip - corner) / length;
    const auto cut = [&](const Grown& line) -> Vec2 {
      const double slope = mitre.dot(line.direction);
      return tip - (length - reach) / slope * line.direction;
    };
    points.push_back(cut(before));
    points.push_back(cut(after));
  }

  void join_hollow(const Grown& before, const Grown& after, const Vec2& corner) {
    const double sine = -cross(before.direction, after.direction), cosine = before.direction.dot(after.direction);
    const double half_tangent = sine / std::max(1e-12, 1.0 + cosine);
    const double trim = half_tangent * std::max(before.distance, after.distance);
    if (before.distance == after.distance && trim < 0.4 * std::min(before.length, after.length))
      return points.push_back(crossing(before, after));
    points.push_back(before.end);
    points.push_back(corner);
    points.push_back(after.start);
  }

  double mitre_limit_;
};

}  // namespace

double polygon_area(const std::vector<Vec2>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

std::vector<Vec2> offset_polygon(const std::vector<Vec2>& polygon, const std::vector<double>& distances,
                                 double mitre_limit) {
  if (polygon.size() != distances.size())
    throw Error(ErrorCode::Internal, "outline", "an offset needs one distance for each segment");
  std::vector<Vec2> distinct;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if ((polygon[(i + 1) % polygon.size()] - polygon[i]).norm() > 0) distinct.push_back(polygon[i]);
  const std::vector<Grown> grown = grow_segments(polygon, distances);
  if (grown.size() < 3) return polygon;
  RawOffset raw(mitre_limit);
  for (std::size_t i = 0; i < grown.size(); ++i)
    raw.join(grown[(i + grown.size() - 1) % grown.size()], grown[i], distinct[i]);
  return positive_outline(raw.points);
}

}  // namespace toile
