// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/conform_loops.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace toile {
namespace {

// Points in square cells of the tolerance's size.
class SharedPoints {
 public:
  explicit SharedPoints(double tolerance) : tolerance_(tolerance) {}

  int number(const Vec2& p) {
    const auto [x, y] = cell(p);
    for (long i = x - 1; i <= x + 1; ++i)
      for (long j = y - 1; j <= y + 1; ++j) {
        const auto found = cells_.find({i, j});
        if (found == cells_.end()) continue;
        for (const int known : found->second)
          if ((points[static_cast<std::size_t>(known)] - p).norm() < tolerance_) return known;
      }
    points.push_back(p);
    cells_[{x, y}].push_back(static_cast<int>(points.size()) - 1);
    return static_cast<int>(points.size()) - 1;
  }

  std::vector<Vec2> points;

 private:
  std::pair<long, long> cell(const Vec2& p) const {
    return {std::lround(std::floor(p.x() / tolerance_)), std::lround(std::floor(p.y() / tolerance_))};
  }
  double tolerance_;
  std::map<std::pair<long, long>, std::vector<int>> cells_;
};

// Numbers of the points that lie on the inside of segment a-b, in order.
std::vector<int> points_on(const std::vector<Vec2>& points, int a, int b, double tolerance) {
  const Vec2 &start = points[static_cast<std::size_t>(a)], &end = points[static_cast<std::size_t>(b)];
  const Vec2 way = end - start;
  const double length = way.norm();
  std::vector<std::pair<double, int>> on;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if (i == a || i == b) continue;
    const Vec2 offset = points[static_cast<std::size_t>(i)] - start;
    const double along = offset.dot(way) / length;
    if (along <= 0 || along >= length) continue;
    if (std::abs(offset.x() * way.y() - offset.y() * way.x()) < tolerance * length) on.emplace_back(along, i);
  }
  std::sort(on.begin(), on.end());
  std::vector<int> numbers;
  for (const auto& [along, i] : on) numbers.push_back(i);
  return numbers;
}

// Without repeated points and spikes a-b-a.
std::vector<int> cleaned(std::vector<int> loop) {
  for (bool changed = true; changed && loop.size() > 2;) {
    changed = false;
    for (std::size_t i = 0; i < loop.size() && loop.size() > 2; ++i) {
      const std::size_t next = (i + 1) % loop.size(), after = (i + 2) % loop.size();
      if (loop[i] == loop[next] || loop[i] == loop[after]) {
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(next));
        changed = true;
        break;
      }
    }
  }
  return loop.size() > 2 ? loop : std::vector<int>();
}

}  // namespace

ConformedLoops conform_loops(const std::vector<std::vector<Vec2>>& loops, double tolerance) {
  SharedPoints shared(tolerance);
  std::vector<std::vector<int>> numbered;
  for (const auto& loop : loops) {
    numbered.emplace_back();
    for (const Vec2& p : loop) numbered.back().push_back(shared.number(p));
  }
  ConformedLoops result;
  for (const std::vector<int>& loop : numbered) {
    std::vector<int> full;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      full.push_back(a);
      if (a == b) continue;
      const std::vector<int> between = points_on(shared.points, a, b, tolerance);
      full.insert(full.end(), between.begin(), between.end());
    }
    result.loops.push_back(cleaned(std::move(full)));
  }
  result.points = std::move(shared.points);
  return result;
}

}  // namespace toile
