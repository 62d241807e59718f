// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/convex_hull.h"

#include <algorithm>

namespace toile {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Appends the chain from the first to the last point of the range, turning left only (Andrew's monotone chain).
template <class Iterator>
void add_chain(Iterator begin, Iterator end, std::vector<Vec2>& hull) {
  const std::size_t base = hull.size();
  for (Iterator p = begin; p != end; ++p) {
    while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
    hull.push_back(*p);
  }
  hull.pop_back();  // it starts the other chain
}

}  // namespace

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  add_chain(points.begin(), points.end(), hull);
  add_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

double hull_perimeter(std::vector<Vec2> points) {
  const std::vector<Vec2> hull = convex_hull(std::move(points));
  double length = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) length += (hull[(i + 1) % hull.size()] - hull[i]).norm();
  return length;
}

}  // namespace toile
