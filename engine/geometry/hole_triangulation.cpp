// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/hole_triangulation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace toile {

namespace {

// Cost of a partial triangulation: the sharpest fold in it as 1 - cosine (0 flat, 2 folded back), then its area.
struct Cost {
  double fold = 0.0;
  double area = 0.0;
  bool operator<(const Cost& other) const { return fold != other.fold ? fold < other.fold : area < other.area; }
};
constexpr Cost kImpossible = {1e9, 1e300};

// Folds below this (about 8 degrees) count as flat: between them the area decides, or noise of the loop would.
constexpr double kFlat = 0.01;

// Least cost of every span i..k of a loop, built from shorter spans to longer ones.
class SpanTable {
 public:
  SpanTable(const HoleLoop& loop, const std::vector<int>& positions) : loop_(loop), positions_(positions) {
    const auto n = positions.size();
    cost_.assign(n * n, Cost{});
    middle_.assign(n * n, -1);
    normal_.assign(n * n, Vec3::Zero());
    for (int i = 0; i < size(); ++i) normal_[slot(i, (i + 1) % size())] = edge_normal(i);
  }

  // Appends the triangles in loop positions; false if there are none.
  bool solve(std::vector<Eigen::Vector3i>& triangles) {
    for (int span = 2; span < size(); ++span)
      for (int i = 0; i + span < size(); ++i) solve_span(i, i + span);
    if (cost_[slot(0, size() - 1)].fold >= kImpossible.fold) return false;
    collect(0, size() - 1, triangles);
    return true;
  }

 private:
  int size() const { return static_cast<int>(positions_.size()); }
  std::size_t slot(int i, int k) const {
    return static_cast<std::size_t>(i) * positions_.size() + static_cast<std::size_t>(k);
  }
  int position(int i) const { return positions_[static_cast<std::size_t>(i)]; }
  const Vec3& point(int i) const { return loop_.points[static_cast<std::size_t>(position(i))]; }

  // Normal of the surface across edge i, or zero where the edge is a cut between two parts of the loop.
  Vec3 edge_normal(int i) const {
    const int a = position(i), b = position((i + 1) % size());
    const bool on_loop = (a + 1) % static_cast<int>(loop_.points.size()) == b;
    return on_loop ? loop_.normals[static_cast<std::size_t>(a)] : Vec3(Vec3::Zero());
  }

  static double fold_between(const Vec3& n, const Vec3& m) {
    if (n.isZero(0) || m.isZero(0)) return 0.0;
    return std::max(0.0, 1.0 - n.dot(m) - kFlat);
  }

  bool is_free(int i, int k) const {
    const bool whole = i == 0 && k == size() - 1;  // the span's own closing edge is an edge of the loop or a cut
    return whole || !loop_.joined(position(i), position(k));
  }

  void solve_span(int i, int k) {
    cost_[slot(i, k)] = kImpossible;
    if (!is_free(i, k)) return;
    const bool whole = i == 0 && k == size() - 1;
    const Vec3 closing = whole ? edge_normal(k) : Vec3(Vec3::Zero());
    for (int m = i + 1; m < k; ++m) {
      const Cost& left = cost_[slot(i, m)];
      const Cost& right = cost_[slot(m, k)];
      if (left.fold >= kImpossible.fold || right.fold >= kImpossible.fold) continue;
      const Vec3 cross = (point(m) - point(i)).cross(point(k) - point(i));
      const double twice_area = cross.norm();
      const Vec3 normal = twice_area > 0 ? Vec3(cross / twice_area) : Vec3(Vec3::Zero());
      Cost cost;
      cost.area = left.area + right.area + twice_area;
      cost.fold = std::max({left.fold, right.fold, fold_between(normal, normal_[slot(i, m)]),
                            fold_between(normal, normal_[slot(m, k)]), fold_between(normal, closing)});
      if (!(cost < cost_[slot(i, k)])) continue;
      cost_[slot(i, k)] = cost;
      middle_[slot(i, k)] = m;
      normal_[slot(i, k)] = normal;
    }
  }

  void collect(int first, int last, std::vector<Eigen::Vector3i>& triangles) const {
    std::vector<std::pair<int, int>> open = {{first, last}};
    while (!open.empty()) {
      const auto [i, k] = open.back();
      open.pop_back();
      if (k - i < 2) continue;
      const int m = middle_[slot(i, k)];
      triangles.emplace_back(position(i), position(m), position(k));
      open.emplace_back(i, m);
      open.emplace_back(m, k);
    }
  }

  const HoleLoop& loop_;
  const std::vector<int>& positions_;
  std::vector<Cost> cost_;
  std::vector<int> middle_;
  std::vector<Vec3> normal_;  // of the triangle that closes the span
};

// The shortest free diagonal, relative to the shorter way round, that leaves at least a quarter on each side.
std::pair<int, int> narrowest_diagonal(const HoleLoop& loop, const std::vector<int>& part) {
  const int n = static_cast<int>(part.size());
  std::pair<int, int> best = {-1, -1};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i)
    for (int k = i + n / 4; k < n && k - i <= n - n / 4; ++k) {
      const int a = part[static_cast<std::size_t>(i)], b = part[static_cast<std::size_t>(k)];
      const double distance =
          (loop.points[static_cast<std::size_t>(a)] - loop.points[static_cast<std::size_t>(b)]).squaredNorm();
      if (distance < least && !loop.joined(a, b)) least = distance, best = {i, k};
    }
  return best;
}

}  // namespace

std::vector<Eigen::Vector3i> triangulate_hole(const HoleLoop& loop, int exact_size) {
  std::vector<int> whole(loop.points.size());
  std::iota(whole.begin(), whole.end(), 0);
  std::vector<std::vector<int>> parts = {whole};
  std::vector<Eigen::Vector3i> triangles;
  while (!parts.empty()) {
    const std::vector<int> part = std::move(parts.back());
    parts.pop_back();
    if (static_cast<int>(part.size()) > exact_size) {
      const auto [i, k] = narrowest_diagonal(loop, part);
      if (i < 0) return {};
      parts.emplace_back(part.begin() + i, part.begin() + k + 1);
      std::vector<int> rest(part.begin() + k, part.end());
      rest.insert(rest.end(), part.begin(), part.begin() + i + 1);
      parts.push_back(std::move(rest));
    } else if (!SpanTable(loop, part).solve(triangles)) {
      return {};
    }
  }
  return triangles;
}

}  // namespace toile
