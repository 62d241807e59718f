// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/trim_slivers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/geometry/polygon_boolean.h"

namespace toile {
namespace {

using Loop = std::vector<Vec2>;

constexpr double kNarrow = 1e-3;     // m: across where a sliver begins
constexpr double kMeanWidth = 5e-4;  // m
constexpr double kSlender = 3.0;     // times as long as it is wide where it begins
constexpr std::size_t kMostCorners = 12;

double perimeter(const Loop& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  return sum;
}

bool is_sliver(const Loop& part, double across) {
  double length = 0.0;
  for (const Vec2& p : part) length = std::max(length, (p - part.front()).norm());
  return length > std::max(kSlender * across, kNarrow) &&
         2.0 * std::abs(signed_area(part)) < kMeanWidth * perimeter(part);
}

// The corners from `from` on that lie beyond the line from there to the edge `corners` further on.
std::optional<Loop> sliver_from(const Loop& outline, std::size_t from, std::size_t corners) {
  const std::size_t n = outline.size();
  const Vec2 &start = outline[from], &a = outline[(from + corners) % n], &b = outline[(from + corners + 1) % n];
  const double squared = (b - a).squaredNorm();
  if (squared == 0.0) return {};
  const Vec2 foot = a + std::clamp((start - a).dot(b - a) / squared, 0.0, 1.0) * (b - a);
  if ((foot - start).norm() > kNarrow) return {};
  Loop part;
  for (std::size_t k = 0; k <= corners; ++k) part.push_back(outline[(from + k) % n]);
  if ((foot - a).norm() > 1e-7) part.push_back(foot);
  if (!is_sliver(part, (foot - start).norm())) return {};
  return part;
}

std::optional<Loop> trim_one(Loop& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t corners = std::min(kMostCorners, n - 3); corners >= 2 && n > 5; --corners) {
      std::optional<Loop> part = sliver_from(outline, i, corners);
      if (!part) continue;
      Loop rest = {part->front()};
      if ((part->back() - outline[(i + corners + 1) % n]).norm() > 1e-7) rest.push_back(part->back());
      for (std::size_t k = corners + 1; k < n; ++k) rest.push_back(outline[(i + k) % n]);
      outline = std::move(rest);
      return part;
    }
  return {};
}

Loop reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

}  // namespace

std::vector<Loop> trim_slivers(Loop& outline) {
  std::vector<Loop> slivers;
  for (const bool backwards : {false, true}) {
    if (backwards) outline = reversed(std::move(outline));
    while (std::optional<Loop> part = trim_one(outline)) slivers.push_back(backwards ? reversed(*part) : *part);
    if (backwards) outline = reversed(std::move(outline));
  }
  return slivers;
}

}  // namespace toile
