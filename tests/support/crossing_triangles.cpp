// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/crossing_triangles.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

namespace toile::test {
namespace {

class CrossingSearch {
 public:
  explicit CrossingSearch(const TriangleMesh& mesh) : mesh_(mesh) {
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      Eigen::AlignedBox3d box;
      for (int k = 0; k < 3; ++k) box.extend(corner(t, k));
      boxes_.push_back(box);
    }
  }

  // Sweeps upward: only triangles whose heights overlap are compared.
  std::vector<std::pair<int, int>> run() {
    std::vector<int> order(boxes_.size()), open;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
    for (const int t : order) {
      std::erase_if(open, [&](int other) { return box(other).max().y() < low(t); });
      for (const int other : open)
        if (box(t).intersects(box(other)) && cross(t, other)) found_.emplace_back(other, t);
      open.push_back(t);
    }
    return std::move(found_);
  }

 private:
  const Eigen::AlignedBox3d& box(int t) const { return boxes_[static_cast<std::size_t>(t)]; }
  double low(int t) const { return box(t).min().y(); }
  Vec3 corner(int t, int k) const { return mesh_.vertices.row(mesh_.triangles(t, k % 3)).transpose(); }

  bool has(int t, int vertex) const { return (mesh_.triangles.row(t).array() == vertex).any(); }

  int shared(int a, int b) const {
    int count = 0;
    for (int k = 0; k < 3; ++k) count += has(b, mesh_.triangles(a, k));
    return count;
  }

  bool cross(int a, int b) const {
    if (shared(a, b) >= 2) return false;
    return edge_through(a, b) || edge_through(b, a);
  }

  // Whether an edge of `a` without a corner of `b` passes through `b`.
  bool edge_through(int a, int b) const {
    for (int k = 0; k < 3; ++k) {
      if (has(b, mesh_.triangles(a, k)) || has(b, mesh_.triangles(a, (k + 1) % 3))) continue;
      if (passes(corner(a, k), corner(a, k + 1), b)) return true;
    }
    return false;
  }

  bool passes(const Vec3& p, const Vec3& q, int t) const {
    const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    const auto volume = [](const Vec3& o, const Vec3& x, const Vec3& y, const Vec3& z) {
      return (x - o).dot((y - o).cross(z - o));
    };
    if (volume(p, a, b, c) * volume(q, a, b, c) >= 0.0) return false;
    const double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
    return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
  }

  const TriangleMesh& mesh_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<std::pair<int, int>> found_;
};

}  // namespace

std::vector<std::pair<int, int>> crossing_triangles(const TriangleMesh& mesh) {
  return CrossingSearch(mesh).run();
}

}  // namespace toile::test
