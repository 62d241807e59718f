// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/self_crossing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/geometry/flat_vectors.h"

namespace toile {

namespace {

struct Segment {
  Vec2 a, b;
};

double distance_to_segment(const Vec2& p, const Segment& s) {
  const Vec2 d = s.b - s.a;
  const double length_squared = d.squaredNorm();
  const double t = length_squared > 0 ? std::clamp((p - s.a).dot(d) / length_squared, 0.0, 1.0) : 0.0;
  return (p - s.a - t * d).norm();
}

bool cross_or_touch(const Segment& s, const Segment& q, double tolerance) {
  const double a = cross(s.b - s.a, q.a - s.a), b = cross(s.b - s.a, q.b - s.a);
  const double c = cross(q.b - q.a, s.a - q.a), d = cross(q.b - q.a, s.b - q.a);
  if (((a > 0) != (b > 0)) && ((c > 0) != (d > 0))) return true;
  return std::min({distance_to_segment(q.a, s), distance_to_segment(q.b, s), distance_to_segment(s.a, q),
                   distance_to_segment(s.b, q)}) <= tolerance;
}

// Neighbours share the point s.b == q.a; wrong is only to run straight back.
bool run_back(const Segment& s, const Segment& q, double tolerance) {
  if ((s.b - s.a).dot(q.b - q.a) >= 0) return false;
  return (q.b - q.a).norm() <= (s.b - s.a).norm() ? distance_to_segment(q.b, s) <= tolerance
                                                  : distance_to_segment(s.a, q) <= tolerance;
}

// The segments of a polygon in the order of a sweep along the longer side of the bounding box.
struct Sweep {
  std::vector<Segment> segments;
  std::vector<int> order;
  int axis = 0;

  explicit Sweep(const std::vector<Vec2>& polygon) {
    Vec2 low = polygon.front(), high = polygon.front();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
      low = low.cwiseMin(polygon[i]);
      high = high.cwiseMax(polygon[i]);
    }
    axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    order.resize(segments.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int i, int j) { return std::pair(least(i, axis), i) < std::pair(least(j, axis), j); });
  }

  const Segment& segment(int i) const { return segments[static_cast<std::size_t>(i)]; }
  double least(int i, int k) const { return std::min(segment(i).a[k], segment(i).b[k]); }
  double most(int i, int k) const { return std::max(segment(i).a[k], segment(i).b[k]); }

  bool is_bad_pair(int before, int after, double tolerance) const {
    const int across = 1 - axis;
    if (least(before, across) > most(after, across) + tolerance ||
        least(after, across) > most(before, across) + tolerance)
      return false;
    if (after == before + 1) return run_back(segment(before), segment(after), tolerance);
    if (before == 0 && after + 1 == static_cast<int>(segments.size()))
      return run_back(segment(after), segment(before), tolerance);
    return cross_or_touch(segment(before), segment(after), tolerance);
  }
};

}  // namespace

std::optional<std::pair<int, int>> find_self_crossing(const std::vector<Vec2>& polygon, double tolerance,
                                                      std::int64_t* comparisons_left) {
  const Sweep sweep(polygon);
  std::vector<int> active;
  for (const int i : sweep.order) {
    if (comparisons_left && (*comparisons_left -= static_cast<std::int64_t>(active.size())) < 0) return std::nullopt;
    const double reached = sweep.least(i, sweep.axis) - tolerance;
    std::erase_if(active, [&](int j) { return sweep.most(j, sweep.axis) < reached; });
    for (const int j : active) {
      const auto [before, after] = std::minmax(i, j);
      if (sweep.is_bad_pair(before, after, tolerance)) return std::pair(before, after);
    }
    active.push_back(i);
  }
  return std::nullopt;
}

}  // namespace toile
