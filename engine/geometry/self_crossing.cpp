// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/self_crossing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace toile {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

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

}  // namespace

std::optional<std::pair<int, int>> find_self_crossing(const std::vector<Vec2>& polygon, double tolerance) {
  const int n = static_cast<int>(polygon.size());
  std::vector<Segment> segments;
  Vec2 low = polygon.front(), high = polygon.front();
  for (int i = 0; i < n; ++i) {
    segments.push_back({polygon[static_cast<std::size_t>(i)], polygon[static_cast<std::size_t>((i + 1) % n)]});
    low = low.cwiseMin(segments.back().a);
    high = high.cwiseMax(segments.back().a);
  }
  // Sweep along the longer side of the bounding box; only segments that overlap there are compared.
  const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
  const auto least = [&](const Segment& s, int k) { return std::min(s.a[k], s.b[k]); };
  const auto most = [&](const Segment& s, int k) { return std::max(s.a[k], s.b[k]); };
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return std::pair(least(segments[static_cast<std::size_t>(i)], axis), i) <
           std::pair(least(segments[static_cast<std::size_t>(j)], axis), j);
  });
  std::optional<std::pair<int, int>> first;
  std::vector<int> active;
  for (const int i : order) {
    const Segment& s = segments[static_cast<std::size_t>(i)];
    std::erase_if(
        active, [&](int j) { return most(segments[static_cast<std::size_t>(j)], axis) < least(s, axis) - tolerance; });
    for (const int j : active) {
      const Segment& q = segments[static_cast<std::size_t>(j)];
      if (least(s, 1 - axis) > most(q, 1 - axis) + tolerance || least(q, 1 - axis) > most(s, 1 - axis) + tolerance)
        continue;
      const int before = std::min(i, j), after = std::max(i, j);
      const bool follows = after == before + 1, closes = before == 0 && after == n - 1;
      const Segment& s0 = segments[static_cast<std::size_t>(closes ? after : before)];
      const Segment& s1 = segments[static_cast<std::size_t>(closes ? before : after)];
      const bool bad = follows || closes ? run_back(s0, s1, tolerance) : cross_or_touch(s, q, tolerance);
      if (bad && (!first || std::pair(before, after) < *first)) first = {before, after};
    }
    active.push_back(i);
  }
  return first;
}

}  // namespace toile
