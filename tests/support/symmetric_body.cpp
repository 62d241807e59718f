// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/symmetric_body.h"

#include <map>

namespace toile::test {
namespace {

class Halver {
 public:
  explicit Halver(const TriangleMesh& surface) : surface_(surface) {}

  TriangleMesh run() {
    for (Eigen::Index f = 0; f < surface_.triangles.rows(); ++f) cut(f);
    TriangleMesh whole;
    whole.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i) whole.vertices.row(static_cast<Eigen::Index>(i)) = points_[i];
    whole.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      whole.triangles.row(static_cast<Eigen::Index>(f)) = triangles_[f].transpose();
    return whole;
  }

 private:
  Vec3 at(int v) const { return surface_.vertices.row(v); }
  bool inside(int v) const { return at(v).x() > 0; }

  int add(const Vec3& p) {
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  // A vertex and its mirror image.
  std::array<int, 2> vertex(int v) {
    const auto [it, fresh] = of_vertex_.try_emplace(v);
    if (fresh) it->second = {add(at(v)), add(Vec3(-at(v).x(), at(v).y(), at(v).z()))};
    return it->second;
  }

  // Where the edge between an inner and an outer vertex meets the plane: its own mirror image.
  std::array<int, 2> crossing(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [it, fresh] = of_edge_.try_emplace({low, high}, 0);
    if (fresh) {
      const double t = at(low).x() / (at(low).x() - at(high).x());
      Vec3 p = at(low) + t * (at(high) - at(low));
      p.x() = 0;
      it->second = add(p);
    }
    return {it->second, it->second};
  }

  void cut(Eigen::Index f) {
    std::vector<std::array<int, 2>> polygon;
    for (int k = 0; k < 3; ++k) {
      const int a = surface_.triangles(f, k), b = surface_.triangles(f, (k + 1) % 3);
      if (inside(a)) polygon.push_back(vertex(a));
      if (inside(a) != inside(b)) polygon.push_back(crossing(a, b));
    }
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      triangles_.emplace_back(polygon[0][0], polygon[k][0], polygon[k + 1][0]);
      triangles_.emplace_back(polygon[0][1], polygon[k + 1][1], polygon[k][1]);
    }
  }

  const TriangleMesh& surface_;
  std::map<int, std::array<int, 2>> of_vertex_;
  std::map<std::pair<int, int>, int> of_edge_;
  std::vector<Vec3> points_;
  std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace

TriangleMesh mirrored_half(const TriangleMesh& surface) {
  return Halver(surface).run();
}

}  // namespace toile::test
