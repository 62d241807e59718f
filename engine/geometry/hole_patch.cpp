// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/hole_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile {

namespace {

constexpr int kMaxRounds = 24;      // each splits every triangle at most once: 3^24 is never reached
constexpr int kMaxFlipSweeps = 32;  // Delaunay flips end by themselves in the plane; in space they are bounded

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

class Refiner {
 public:
  Refiner(HolePatch& patch, int max_points) : patch_(patch), max_points_(max_points) {}

  void run() {
    make_delaunay();
    for (int round = 0; round < kMaxRounds && split_all(); ++round) make_delaunay();
  }

 private:
  const Vec3& point(int i) const { return patch_.points[at(i)]; }

  bool is_too_large(const Eigen::Vector3i& t, const Vec3& centre, double spacing) const {
    // sqrt(2) as in Liepa: a centre that would stand closer than that to a corner only makes the patch denser.
    for (int k = 0; k < 3; ++k) {
      const double distance = std::numbers::sqrt2 * (centre - point(t[k])).norm();
      if (distance <= spacing || distance <= patch_.spacing[at(t[k])]) return false;
    }
    return true;
  }

  bool split_all() {
    const std::size_t count = patch_.triangles.size();
    bool split = false;
    for (std::size_t f = 0; f < count && static_cast<int>(patch_.points.size()) < max_points_; ++f) {
      const Eigen::Vector3i t = patch_.triangles[f];
      const Vec3 centre = (point(t[0]) + point(t[1]) + point(t[2])) / 3.0;
      const double spacing = (patch_.spacing[at(t[0])] + patch_.spacing[at(t[1])] + patch_.spacing[at(t[2])]) / 3.0;
      if (!is_too_large(t, centre, spacing)) continue;
      const int c = static_cast<int>(patch_.points.size());
      patch_.points.push_back(centre);
      patch_.spacing.push_back(spacing);
      patch_.triangles[f] = {t[0], t[1], c};
      patch_.triangles.emplace_back(t[1], t[2], c);
      patch_.triangles.emplace_back(t[2], t[0], c);
      split = true;
    }
    return split;
  }

  using Edge = std::pair<int, int>;
  struct EdgeTriangles {
    int first = -1, second = -1;
  };
  static Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

  static int opposite_corner(const Eigen::Vector3i& t, const Edge& e) {
    for (int k = 0; k < 3; ++k)
      if (t[k] != e.first && t[k] != e.second) return t[k];
    return -1;
  }

  static double angle_at(const Vec3& p, const Vec3& a, const Vec3& b) {
    return std::atan2((a - p).cross(b - p).norm(), (a - p).dot(b - p));
  }

  void make_delaunay() {
    std::map<Edge, EdgeTriangles> edges;
    for (std::size_t f = 0; f < patch_.triangles.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        EdgeTriangles& found = edges[edge(patch_.triangles[f][k], patch_.triangles[f][(k + 1) % 3])];
        (found.first < 0 ? found.first : found.second) = static_cast<int>(f);
      }
    for (int sweep = 0; sweep < kMaxFlipSweeps; ++sweep) {
      std::vector<Edge> inner;
      for (const auto& [e, triangles] : edges)
        if (triangles.second >= 0) inner.push_back(e);
      bool flipped = false;
      for (const Edge& e : inner) flipped = flip_if_better(e, edges) || flipped;
      if (!flipped) return;
    }
  }

  bool is_joined(int a, int b, const std::map<Edge, EdgeTriangles>& edges) const {
    if (edges.count(edge(a, b)) > 0) return true;
    return a < patch_.loop_size && b < patch_.loop_size && patch_.joined(a, b);
  }

  bool flip_if_better(const Edge& e, std::map<Edge, EdgeTriangles>& edges) {
    const EdgeTriangles pair = edges.at(e);
    const Eigen::Vector3i first = patch_.triangles[at(pair.first)];
    const int c = opposite_corner(first, e), d = opposite_corner(patch_.triangles[at(pair.second)], e);
    const double angles =
        angle_at(point(c), point(e.first), point(e.second)) + angle_at(point(d), point(e.first), point(e.second));
    if (angles <= std::numbers::pi + 1e-9 || is_joined(c, d, edges)) return false;
    int k = 0;
    while (first[k] == c || first[(k + 1) % 3] == c) ++k;
    const int a = first[k], b = first[(k + 1) % 3];  // abc is the first triangle, bad the second
    patch_.triangles[at(pair.first)] = {c, a, d};
    patch_.triangles[at(pair.second)] = {d, b, c};
    edges.erase(e);
    edges[edge(c, d)] = pair;
    replace(edges.at(edge(a, d)), pair.second, pair.first);
    replace(edges.at(edge(b, c)), pair.first, pair.second);
    return true;
  }

  static void replace(EdgeTriangles& found, int from, int to) {
    (found.first == from ? found.first : found.second) = to;
  }

  HolePatch& patch_;
  int max_points_;
};

}  // namespace

void refine_patch(HolePatch& patch, int max_points) {
  Refiner(patch, max_points).run();
}

}  // namespace toile
