// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/polygon_boolean.h"

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

// A loop that touches or crosses itself: the triangles of a fan, each wound as it comes, would cancel; so the loop is
// cut at its first point of crossing by the arrangement of its segments and every bounded face it winds around is kept.
void join_crossing(PolygonSet& set, const std::vector<Vec2>& loop) {
  CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>> arrangement;
  std::vector<CGAL::Arr_segment_traits_2<Kernel>::Curve_2> segments;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &p = loop[i], &q = loop[(i + 1) % loop.size()];
    segments.emplace_back(Point(p.x(), p.y()), Point(q.x(), q.y()));
  }
  CGAL::insert(arrangement, segments.begin(), segments.end());
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
    if (face->is_unbounded() || !face->has_outer_ccb()) continue;
    Polygon polygon;
    auto edge = face->outer_ccb(), first = edge;
    do polygon.push_back(edge->source()->point());
    while (++edge != first);
    if (!polygon.is_simple()) continue;  // a face pinched by an antenna encloses its neighbours' outline
    if (polygon.is_clockwise_oriented()) polygon.reverse_orientation();
    const Vec2 inside = [&] {
      const auto a = polygon[0], b = polygon[1];
      const double ax = CGAL::to_double(a.x()), ay = CGAL::to_double(a.y());
      const double bx = CGAL::to_double(b.x()), by = CGAL::to_double(b.y());
      const double length = std::hypot(bx - ax, by - ay), nudge = 1e-3 * length;
      return Vec2(0.5 * (ax + bx) - nudge * (by - ay) / length, 0.5 * (ay + by) + nudge * (bx - ax) / length);
    }();
    double winding = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 p = loop[i] - inside, q = loop[(i + 1) % loop.size()] - inside;
      winding += std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
    }
    if (std::abs(winding) > 1.0) set.join(polygon);
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
