// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/decimate.h"

#include <algorithm>
#include <queue>

#include "engine/geometry/components.h"

namespace toile {
namespace {

constexpr double kHold = 3e-3;       // weight of a vertex's own place against the planes of its triangles
constexpr double kFoldCosine = 0.2;  // a triangle may not turn further than this in one collapse

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

// x^T A x - 2 b^T x + c, a sum of squared distances to planes and points.
struct Quadric {
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0.0;

  void add_plane(const Vec3& unit, double offset, double weight) {
    a += weight * unit * unit.transpose();
    b += weight * offset * unit;
    c += weight * offset * offset;
  }
  void add_point(const Vec3& p, double weight) {
    a += weight * Mat3::Identity();
    b += weight * p;
    c += weight * p.squaredNorm();
  }
  Quadric operator+(const Quadric& o) const { return {a + o.a, b + o.b, c + o.c}; }
  double operator()(const Vec3& x) const { return x.dot(a * x) - 2.0 * b.dot(x) + c; }
};

struct Candidate {
  double cost;
  int a, b;
  int version;  // sum of both vertices' versions when it was priced
  bool operator>(const Candidate& o) const {
    if (cost != o.cost) return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

class Decimator {
 public:
  explicit Decimator(const TriangleMesh& mesh) : mesh_(mesh) {
    const auto n = at(mesh.vertex_count());
    quadric_.resize(n), fan_.resize(n), version_.assign(n, 0), alive_.assign(n, true);
    triangle_alive_.assign(at(mesh.triangle_count()), true);
    for (int f = 0; f < mesh.triangle_count(); ++f) add_triangle(f);
    for (int v = 0; v < mesh.vertex_count(); ++v)
      for (const int n2 : neighbours(v))
        if (n2 > v) push(v, n2);
  }

  TriangleMesh run(int vertices) {
    int left = mesh_.vertex_count();
    while (left > vertices && !open_.empty()) {
      const Candidate c = open_.top();
      open_.pop();
      if (!alive_[at(c.a)] || !alive_[at(c.b)] || c.version != version_[at(c.a)] + version_[at(c.b)]) continue;
      if (collapse(c.a, c.b)) --left;
    }
    return extract_triangles(mesh_, triangle_alive_);
  }

 private:
  Vec3 point(int v) const { return mesh_.vertices.row(v); }

  void add_triangle(int f) {
    const Vec3 cross = triangle_cross(mesh_, f);
    const double twice_area = cross.norm();
    for (int k = 0; k < 3; ++k) {
      const int v = mesh_.triangles(f, k);
      fan_[at(v)].push_back(f);
      if (twice_area <= 0) continue;
      const Vec3 unit = cross / twice_area;
      quadric_[at(v)].add_plane(unit, unit.dot(point(v)), twice_area);
      quadric_[at(v)].add_point(point(v), kHold * twice_area);
    }
  }

  std::vector<int> neighbours(int v) const {
    std::vector<int> out;
    for (const int f : fan_[at(v)])
      for (int k = 0; k < 3; ++k)
        if (mesh_.triangles(f, k) != v) out.push_back(mesh_.triangles(f, k));
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  static Vec3 best_place(const Quadric& q, const Vec3& middle) {
    const Eigen::LDLT<Mat3> solver(q.a);
    const Vec3 x = solver.solve(q.b);
    return solver.info() == Eigen::Success && x.allFinite() ? x : middle;
  }

  void push(int a, int b) {
    const Quadric q = quadric_[at(a)] + quadric_[at(b)];
    const Vec3 x = best_place(q, 0.5 * (point(a) + point(b)));
    open_.push({q(x), a, b, version_[at(a)] + version_[at(b)]});
  }

  // Two vertices may merge if all they share are the two vertices across their edge.
  bool keeps_topology(int a, int b) const {
    const auto na = neighbours(a), nb = neighbours(b);
    std::vector<int> common;
    std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::back_inserter(common));
    return common.size() == 2 && na.size() + nb.size() > 7;
  }

  bool folds(int v, int other, const Vec3& to) const {
    for (const int f : fan_[at(v)]) {
      std::array<Vec3, 3> p;
      bool shared = false;
      for (int k = 0; k < 3; ++k) {
        const int corner = mesh_.triangles(f, k);
        shared |= corner == other;
        p[at(k)] = corner == v ? to : point(corner);
      }
      if (shared) continue;
      const Vec3 before = triangle_cross(mesh_, f), after = (p[1] - p[0]).cross(p[2] - p[0]);
      if (after.dot(before) < kFoldCosine * after.norm() * before.norm()) return true;
    }
    return false;
  }

  bool collapse(int a, int b) {
    const Quadric q = quadric_[at(a)] + quadric_[at(b)];
    const Vec3 to = best_place(q, 0.5 * (point(a) + point(b)));
    if (!keeps_topology(a, b) || folds(a, b, to) || folds(b, a, to)) return false;
    for (const int f : fan_[at(b)]) {
      bool shared = false;
      for (int k = 0; k < 3; ++k) shared |= mesh_.triangles(f, k) == a;
      if (shared) {
        triangle_alive_[at(f)] = false;
        for (int k = 0; k < 3; ++k)
          if (const int v = mesh_.triangles(f, k); v != b) std::erase(fan_[at(v)], f);
      } else {
        for (int k = 0; k < 3; ++k)
          if (mesh_.triangles(f, k) == b) mesh_.triangles(f, k) = a;
        fan_[at(a)].push_back(f);
      }
    }
    fan_[at(b)].clear();
    alive_[at(b)] = false;
    mesh_.vertices.row(a) = to;
    quadric_[at(a)] = q;
    ++version_[at(a)];
    for (const int n : neighbours(a)) push(std::min(a, n), std::max(a, n));
    return true;
  }

  TriangleMesh mesh_;
  std::vector<Quadric> quadric_;
  std::vector<std::vector<int>> fan_;  // triangles round each vertex
  std::vector<int> version_;
  std::vector<bool> alive_, triangle_alive_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open_;
};

}  // namespace

TriangleMesh decimate(const TriangleMesh& mesh, int vertices) {
  if (mesh.vertex_count() <= vertices) return mesh;
  return Decimator(mesh).run(vertices);
}

}  // namespace toile
