// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/split_polygon.h"

#include <cmath>
#include <optional>

#include "engine/geometry/flat_vectors.h"
#include "engine/geometry/polygon_boolean.h"

namespace toile {
namespace {

using Loop = std::vector<Vec2>;

constexpr double kTwoCorners = 0.4;  // a chord that ends in another reflex corner mends both: worth this much more
constexpr double kSamePoint = 1e-9;  // m

// Unit direction from corner `i` to the outline `reach` away, forwards or backwards.
Vec2 direction(const Loop& loop, std::size_t i, double reach, bool forwards) {
  const std::size_t n = loop.size();
  double left = reach;
  std::size_t k = i;
  for (std::size_t step = 0; step < n; ++step) {
    const std::size_t next = forwards ? (k + 1) % n : (k + n - 1) % n;
    const double length = (loop[next] - loop[k]).norm();
    if (length >= left) return (loop[k] + left / length * (loop[next] - loop[k]) - loop[i]).normalized();
    left -= length;
    k = next;
  }
  return Vec2::Zero();
}

struct Hit {
  double distance;
  std::size_t edge;  // from loop[edge] to the next
  Vec2 point;
};

// First edge that a ray from corner `i` meets.
std::optional<Hit> shoot(const Loop& loop, std::size_t i, const Vec2& way) {
  std::optional<Hit> first;
  const std::size_t n = loop.size();
  for (std::size_t e = 0; e < n; ++e) {
    if (e == i || (e + 1) % n == i) continue;
    const Vec2 p = loop[e] - loop[i], along = loop[(e + 1) % n] - loop[e];
    const double slope = cross(way, along);
    if (slope == 0.0) continue;
    const double distance = cross(p, along) / slope, t = cross(p, way) / slope;
    if (t < 0.0 || t > 1.0 || distance <= 1e-9 || (first && distance >= first->distance)) continue;
    first = Hit{distance, e, loop[i] + distance * way};
  }
  return first;
}

struct Parts {
  Loop a, b;
  double chord;
};

bool is_reflex(const Loop& loop, std::size_t i, const SplitPolygonOptions& options) {
  const Vec2 to = direction(loop, i, options.reach, true), from = direction(loop, i, options.reach, false);
  return std::atan2(cross(-from, to), -from.dot(to)) <= -options.least_turn;
}

std::optional<Parts> cut_along(const Loop& loop, std::size_t i, const Vec2& way, const SplitPolygonOptions& options) {
  const std::optional<Hit> hit = shoot(loop, i, way);
  if (!hit) return std::nullopt;
  const std::size_t n = loop.size();
  std::size_t end = (hit->edge + 1) % n;  // corner the chord ends in, where one is near
  Parts parts{{}, {}, hit->distance};
  const double near = 0.25 * hit->distance;
  const bool at_next = (loop[end] - hit->point).norm() < near && is_reflex(loop, end, options);
  const bool at_edge = !at_next && (loop[hit->edge] - hit->point).norm() < near && is_reflex(loop, hit->edge, options);
  if (at_edge) end = hit->edge;
  if (at_next || at_edge) parts.chord *= kTwoCorners;
  for (std::size_t k = i; k != end; k = (k + 1) % n) parts.a.push_back(loop[k]);
  parts.a.push_back(at_next || at_edge ? loop[end] : hit->point);
  if (!at_next && !at_edge && (loop[end] - hit->point).norm() > kSamePoint) parts.b.push_back(hit->point);
  for (std::size_t k = end; k != i; k = (k + 1) % n) parts.b.push_back(loop[k]);
  parts.b.push_back(loop[i]);
  if (parts.a.size() < 3 || parts.b.size() < 3) return std::nullopt;
  if (signed_area(parts.a) < options.least_area || signed_area(parts.b) < options.least_area) return std::nullopt;
  return parts;
}

// The cut with the shortest chord over all reflex corners.
std::optional<Parts> best_cut(const Loop& loop, const SplitPolygonOptions& options) {
  std::optional<Parts> best;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (!is_reflex(loop, i, options)) continue;
    const Vec2 to = direction(loop, i, options.reach, true), from = direction(loop, i, options.reach, false);
    for (const Vec2& way : {Vec2(-from), Vec2(-to)}) {
      std::optional<Parts> parts = cut_along(loop, i, way, options);
      if (parts && (!best || parts->chord < best->chord)) best = std::move(parts);
    }
  }
  return best;
}

}  // namespace

std::vector<Loop> split_at_reflex_corners(const Loop& outline, const SplitPolygonOptions& options) {
  std::vector<Loop> open = {outline}, done;
  while (!open.empty()) {
    const Loop loop = std::move(open.back());
    open.pop_back();
    std::optional<Parts> parts = best_cut(loop, options);
    if (!parts) {
      done.push_back(loop);
      continue;
    }
    open.push_back(std::move(parts->b));
    open.push_back(std::move(parts->a));
  }
  return done;
}

}  // namespace toile
