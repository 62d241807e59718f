// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/polygon_boolean.h"

#include <algorithm>
#include <cmath>
#include <list>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include "engine/core/error.h"

namespace toile {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonHoles = CGAL::Polygon_with_holes_2<Kernel>;
using PolygonSet = CGAL::Polygon_set_2<Kernel>;

constexpr double kGrid = 1073741824.0;  // 2^30 steps a metre

double snapped(double value) {
  if (!std::isfinite(value)) throw Error(ErrorCode::GarmentInvalid, "polygon", "a coordinate is not finite");
  return std::round(value * kGrid) / kGrid;
}

std::vector<Vec2> cleaned(const std::vector<Vec2>& loop) {
  std::vector<Vec2> result;
  for (const Vec2& p : loop) {
    const Vec2 q(snapped(p.x()), snapped(p.y()));
    if (result.empty() || q != result.back()) result.push_back(q);
  }
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  return result;
}

Polygon to_cgal(const std::vector<Vec2>& loop) {
  Polygon polygon;
  for (const Vec2& p : loop) polygon.push_back(Point(p.x(), p.y()));
  return polygon;
}

using Traits = CGAL::Arr_segment_traits_2<Kernel>;
using Arrangement = CGAL::Arrangement_2<Traits>;

// Closed walks that visit no point twice, of one that may.
std::vector<Polygon> simple_walks(const std::vector<Point>& walk) {
  std::vector<Polygon> loops;
  std::vector<Point> open;
  for (const Point& p : walk) {
    const auto seen = std::find(open.begin(), open.end(), p);
    if (seen == open.end()) {
      open.push_back(p);
      continue;
    }
    loops.emplace_back(seen, open.end());
    open.erase(seen + 1, open.end());
  }
  loops.emplace_back(open.begin(), open.end());
  return loops;
}

// How often a loop winds around a point on the left of the segment p -> q, next to its middle.
double winding_beside(const std::vector<Vec2>& loop, const Vec2& p, const Vec2& q) {
  const Vec2 way = q - p, inside = 0.5 * (p + q) + 1e-4 * Vec2(-way.y(), way.x());
  double angle = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i] - inside, b = loop[(i + 1) % loop.size()] - inside;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(angle);
}

// A loop that touches or crosses itself: every face of the arrangement of its segments that it winds around.
void join_crossing(PolygonSet& set, const std::vector<Vec2>& loop) {
  Arrangement arrangement;
  std::vector<Traits::Curve_2> segments;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &p = loop[i], &q = loop[(i + 1) % loop.size()];
    segments.emplace_back(Point(p.x(), p.y()), Point(q.x(), q.y()));
  }
  CGAL::insert(arrangement, segments.begin(), segments.end());
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
    if (face->is_unbounded() || !face->has_outer_ccb()) continue;
    std::vector<Point> walk;
    auto edge = face->outer_ccb(), first = edge;
    do walk.push_back(edge->source()->point());
    while (++edge != first);
    const Vec2 p(CGAL::to_double(walk[0].x()), CGAL::to_double(walk[0].y()));
    const Vec2 q(CGAL::to_double(walk[1].x()), CGAL::to_double(walk[1].y()));
    if (winding_beside(loop, p, q) < 1.0) continue;
    for (const Polygon& polygon : simple_walks(walk))
      if (polygon.size() > 2 && polygon.is_counterclockwise_oriented()) set.join(polygon);
  }
}

PolygonSet to_set(const Loops& loops) {
  PolygonSet set;
  std::vector<Polygon> simple;
  for (const auto& raw : loops) {
    const std::vector<Vec2> loop = cleaned(raw);
    if (loop.size() < 3) continue;
    Polygon polygon = to_cgal(loop);
    if (!polygon.is_simple()) {
      join_crossing(set, loop);
      continue;
    }
    if (polygon.is_collinear_oriented()) continue;
    if (polygon.is_clockwise_oriented()) polygon.reverse_orientation();
    simple.push_back(polygon);
  }
  set.join(simple.begin(), simple.end());
  return set;
}

std::vector<Vec2> from_cgal(const Polygon& polygon) {
  std::vector<Vec2> loop;
  for (auto p = polygon.vertices_begin(); p != polygon.vertices_end(); ++p)
    loop.emplace_back(CGAL::to_double(p->x()), CGAL::to_double(p->y()));
  return loop;
}

std::vector<PolygonWithHoles> from_set(const PolygonSet& set) {
  std::list<PolygonHoles> found;
  set.polygons_with_holes(std::back_inserter(found));
  std::vector<PolygonWithHoles> result;
  for (const PolygonHoles& polygon : found) {
    PolygonWithHoles next{from_cgal(polygon.outer_boundary()), {}};
    for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole) next.holes.push_back(from_cgal(*hole));
    result.push_back(std::move(next));
  }
  return result;
}

}  // namespace

double signed_area(const std::vector<Vec2>& loop) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 p = loop[i] - loop[0], q = loop[(i + 1) % loop.size()] - loop[0];
    doubled += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * doubled;
}

double area(const PolygonWithHoles& polygon) {
  double sum = std::abs(signed_area(polygon.outline));
  for (const auto& hole : polygon.holes) sum -= std::abs(signed_area(hole));
  return sum;
}

double area(const std::vector<PolygonWithHoles>& polygons) {
  double sum = 0.0;
  for (const PolygonWithHoles& polygon : polygons) sum += area(polygon);
  return sum;
}

bool is_simple_polygon(const std::vector<Vec2>& loop) {
  const std::vector<Vec2> clean = cleaned(loop);
  return clean.size() >= 3 && to_cgal(clean).is_simple();
}

std::vector<PolygonWithHoles> polygon_union(const Loops& a) {
  return from_set(to_set(a));
}

std::vector<PolygonWithHoles> polygon_difference(const Loops& a, const Loops& b) {
  PolygonSet set = to_set(a);
  set.difference(to_set(b));
  return from_set(set);
}

std::vector<PolygonWithHoles> polygon_intersection(const Loops& a, const Loops& b) {
  PolygonSet set = to_set(a);
  set.intersection(to_set(b));
  return from_set(set);
}

}  // namespace toile
