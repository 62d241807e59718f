// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/part_openings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/geometry/inner_point.h"
#include "engine/geometry/split_polygon.h"

namespace toile {
namespace {

using Loop = std::vector<Vec2>;

constexpr double kCrumb = 0.8;       // of the least width: a strip of just that is none, however its width is measured
constexpr double kOnOutline = 1e-6;  // m
constexpr double kSamePoint = 1e-6;  // m
constexpr double kShared = 2e-5;     // m: borders nearer than this run along each other

double perimeter(const Loop& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  return sum;
}

Vec2 nearest_on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double squared = (b - a).squaredNorm();
  return squared > 0.0 ? Vec2(a + std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) * (b - a)) : a;
}

// Corners from the one after `first` to `last`, closed by `end`.
Loop part_between(const Loop& loop, std::size_t first, std::size_t last, const Vec2& end) {
  Loop part = {end};
  for (std::size_t k = (first + 1) % loop.size();; k = (k + 1) % loop.size()) {
    if ((loop[k] - end).norm() > kSamePoint) part.push_back(loop[k]);
    if (k == last) break;
  }
  return part;
}

struct Neck {
  double width;
  Loop a, b;
};

// The narrowest place that leaves something worth sewing on either side.
std::optional<Neck> narrowest_neck(const Loop& loop, const Loop& wanted, const PartOpeningOptions& options) {
  std::optional<Neck> narrowest;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t e = 0; e < n; ++e) {
      const std::size_t next = (e + 1) % n;
      if (e == i || next == i) continue;
      const Vec2 across = nearest_on_segment(loop[i], loop[e], loop[next]);
      const double width = (across - loop[i]).norm();
      if (width >= options.least_width || (narrowest && width >= narrowest->width)) continue;
      const bool own = distance_to_polygon(wanted, loop[i]) < kOnOutline,
                 other = distance_to_polygon(wanted, across) < kOnOutline;
      if (own && other && width > kSamePoint) continue;  // the wanted panel itself is that narrow
      const Vec2 end = own ? loop[i] : other ? across : Vec2(0.5 * (loop[i] + across));
      Neck neck{width, part_between(loop, i, e, end), part_between(loop, e, (i + n - 1) % n, end)};
      if (worth_sewing(neck.a, options) && worth_sewing(neck.b, options)) narrowest = std::move(neck);
    }
  return narrowest;
}

double shared_border(const Loop& a, const Loop& b) {
  double shared = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 &from = a[i], &to = a[(i + 1) % a.size()];
    if (distance_to_polygon(b, 0.5 * (from + to)) < kShared) shared += (to - from).norm();
  }
  return shared;
}

// Joins a strip to the one it shares most of its border with; false where that is none.
bool join(std::vector<Loop>& strips, std::size_t crumb) {
  std::size_t neighbour = crumb;
  double most = 0.0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const double shared = i == crumb ? 0.0 : shared_border(strips[crumb], strips[i]);
    if (shared > most) most = shared, neighbour = i;
  }
  if (neighbour == crumb) return false;
  const auto joined = polygon_union({strips[crumb], strips[neighbour]});
  if (joined.size() != 1 || !joined[0].holes.empty()) return false;
  strips[neighbour] = joined[0].outline;
  strips.erase(strips.begin() + static_cast<std::ptrdiff_t>(crumb));
  return true;
}

}  // namespace

bool worth_sewing(const Loop& opening, const PartOpeningOptions& options) {
  if (opening.size() < 3) return false;
  const double size = signed_area(opening);
  return size >= options.least_area && 2.0 * size / perimeter(opening) >= options.least_width;
}

std::vector<Loop> parted_at_necks(const Loop& opening, const Loop& wanted, const PartOpeningOptions& options) {
  std::vector<Loop> open = {opening}, parts;
  while (!open.empty()) {
    Loop loop = std::move(open.back());
    open.pop_back();
    std::optional<Neck> neck = narrowest_neck(loop, wanted, options);
    if (!neck) {
      parts.push_back(std::move(loop));
      continue;
    }
    open.push_back(std::move(neck->b));
    open.push_back(std::move(neck->a));
  }
  return parts;
}

std::vector<Loop> strips_of(const Loop& opening, const PartOpeningOptions& options) {
  if (options.l_shapes) return {opening};
  std::vector<Loop> strips = split_at_reflex_corners(opening);
  for (std::size_t i = 0; i < strips.size() && strips.size() > 1;)
    if (2.0 * roomiest_point(strips[i]).clearance >= kCrumb * options.least_strip || !join(strips, i))
      ++i;
    else
      i = 0;
  return strips;
}

}  // namespace toile
