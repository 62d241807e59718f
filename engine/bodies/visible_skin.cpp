// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/visible_skin.h"

#include <algorithm>
#include <numbers>

#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

constexpr int kAxes = 24;          // each seen from both ends
constexpr int kSeenFrom = 3;       // of 48: a twentieth
constexpr double kPixel = 0.004;   // m
constexpr double kBehind = 0.008;  // m
constexpr double kGrazing = 0.1;   // cosine under which a surface says nothing in a picture

// Directions spread evenly over a half sphere (golden-angle spiral).
Vec3 axis(int i) {
  const double z = (i + 0.5) / kAxes, r = std::sqrt(1.0 - z * z);
  const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

// Nearest and furthest depth along one axis.
class DepthPicture {
 public:
  DepthPicture(const TriangleMesh& body, const Vec3& direction) {
    const Vec3 u = direction.unitOrthogonal();
    frame_.row(0) = u, frame_.row(1) = direction.cross(u), frame_.row(2) = direction;
    points_ = body.vertices * frame_.transpose();
    origin_ = points_.leftCols<2>().colwise().minCoeff();
    const Vec2 size = points_.leftCols<2>().colwise().maxCoeff().transpose() - origin_;
    width_ = static_cast<int>(size.x() / kPixel) + 1;
    const int height = static_cast<int>(size.y() / kPixel) + 1;
    near_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height), 1e30F);
    far_.assign(near_.size(), -1e30F);
    for (Eigen::Index f = 0; f < body.triangles.rows(); ++f) draw(body.triangles.row(f));
  }

  // Whether vertex v lies at the front (towards -direction) or at the back of the picture.
  bool at_front(Eigen::Index v) const { return points_(v, 2) <= near_[pixel(points_.row(v))] + kBehind; }
  bool at_back(Eigen::Index v) const { return points_(v, 2) >= far_[pixel(points_.row(v))] - kBehind; }

 private:
  int column(double x) const { return static_cast<int>((x - origin_.x()) / kPixel); }
  int row(double y) const { return static_cast<int>((y - origin_.y()) / kPixel); }
  std::size_t pixel(const Vec3& p) const {
    return static_cast<std::size_t>(row(p.y())) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column(p.x()));
  }

  // Every pixel whose middle the triangle covers; its corners leave their depth as well, so that none slips through.
  void draw(const Eigen::Vector3i& t) {
    const Vec3 a = points_.row(t[0]), b = points_.row(t[1]), c = points_.row(t[2]);
    for (const Vec3* p : {&a, &b, &c}) mark(pixel(*p), p->z());
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (std::abs(area) < 1e-12) return;
    const int x0 = column(std::min({a.x(), b.x(), c.x()})), x1 = column(std::max({a.x(), b.x(), c.x()}));
    const int y0 = row(std::min({a.y(), b.y(), c.y()})), y1 = row(std::max({a.y(), b.y(), c.y()}));
    for (int j = y0; j <= y1; ++j)
      for (int i = x0; i <= x1; ++i) {
        const double x = origin_.x() + (i + 0.5) * kPixel, y = origin_.y() + (j + 0.5) * kPixel;
        const double wb = ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / area;
        const double wc = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        mark(static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i),
             a.z() + wb * (b.z() - a.z()) + wc * (c.z() - a.z()));
      }
  }

  void mark(std::size_t i, double depth) {
    near_[i] = std::min(near_[i], static_cast<float>(depth));
    far_[i] = std::max(far_[i], static_cast<float>(depth));
  }

  Mat3 frame_;
  Points3 points_;
  Vec2 origin_;
  int width_ = 0;
  std::vector<float> near_, far_;
};

}  // namespace

Eigen::VectorXd visible_skin(const TriangleMesh& body) {
  const Points3 normals = vertex_normals(body.vertices, body.triangles);
  Eigen::VectorXi seen = Eigen::VectorXi::Zero(body.vertex_count());
  for (int i = 0; i < kAxes; ++i) {
    const Vec3 direction = axis(i);
    const DepthPicture picture(body, direction);
    for (Eigen::Index v = 0; v < seen.size(); ++v) {
      const double facing = normals.row(v).dot(direction);
      if (facing < -kGrazing) seen[v] += picture.at_front(v);
      if (facing > kGrazing) seen[v] += picture.at_back(v);
    }
  }
  return (seen.array() >= kSeenFrom).cast<double>();
}

}  // namespace toile
