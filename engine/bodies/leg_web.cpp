// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/leg_web.h"

#include <algorithm>

#include "engine/geometry/closest_point.h"
#include "engine/geometry/components.h"
#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

constexpr int kTaubinSteps = 4;                         // against noise in normals
constexpr double kFoldDepth = 0.015, kFoldWide = 0.03;  // m
constexpr double kWall = 0.7;                           // cosine to the side over which skin is a wall of the fold
// Fractions of the height: where the crotch may be, how near to the mid-plane a web is, and how far walls reach.
constexpr double kLow = 0.36, kHigh = 0.56, kCentral = 0.02, kLegs = 0.10, kMargin = 0.06;

// The inner sides of the legs, asked for what lies beside a point.
class Walls {
 public:
  Walls(const Points3& vertices, const Triangles& triangles, double height) {
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      const auto t = triangles.row(f);
      const Vec3 a = vertices.row(t[0]);
      if (std::abs(a.x()) > kLegs * height || a.y() < (kLow - kMargin) * height || a.y() > (kHigh + kMargin) * height)
        continue;
      walls_.push_back({a, vertices.row(t[1]), vertices.row(t[2])});
    }
  }

  // From the nearest skin at one side of the point to that at the other; far where there is none.
  double apart(const Vec3& p) const {
    double left = 1e300, right = 1e300;
    for (const auto& [a, b, c] : walls_) {
      if (std::max({a.y(), b.y(), c.y()}) < p.y() || std::min({a.y(), b.y(), c.y()}) > p.y()) continue;
      double x = 0.0;
      const auto flat = [](const Vec3& v) { return Vec3(v.y(), v.z(), v.x()); };
      if (line_crossing({p.y(), p.z()}, flat(a), flat(b), flat(c), x) == 0) continue;
      (x > p.x() ? left : right) = std::min(x > p.x() ? left : right, std::abs(x - p.x()));
    }
    return left + right;
  }

 private:
  std::vector<std::array<Vec3, 3>> walls_;
};

}  // namespace

TriangleMesh without_leg_web(const TriangleMesh& scan) {
  if (surface_roughness(scan) < kRoughScan) return scan;
  const double h = scan.vertices.col(1).maxCoeff();
  const Points3 smooth = taubin_smooth(scan, kTaubinSteps);
  const Points3 normals = vertex_normals(smooth, scan.triangles);
  const Walls walls(smooth, scan.triangles, h);
  std::vector<bool> web(static_cast<std::size_t>(scan.vertex_count()), false);
  for (Eigen::Index v = 0; v < smooth.rows(); ++v) {
    const Vec3 p = smooth.row(v), n = normals.row(v);
    if (std::abs(p.x()) > kCentral * h || p.y() < kLow * h || p.y() > kHigh * h || std::abs(n.x()) > kWall) continue;
    web[static_cast<std::size_t>(v)] = walls.apart(p + kFoldDepth * n) < kFoldWide;
  }
  std::vector<bool> keep(static_cast<std::size_t>(scan.triangle_count()), true);
  for (Eigen::Index f = 0; f < scan.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (web[static_cast<std::size_t>(scan.triangles(f, k))]) keep[static_cast<std::size_t>(f)] = false;
  return extract_triangles(scan, keep);
}

}  // namespace toile
