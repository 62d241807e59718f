// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/energy_hessian.h"

#include <cmath>

#include "engine/sim/contact.h"
#include "engine/sim/membrane.h"

namespace toile {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

Vec6 stacked(const Vec3& a, const Vec3& b) {
  Vec6 both;
  both << a[0], a[1], a[2], b[0], b[1], b[2];
  return both;
}

// Of k (|f| - 1)^2 / 2 by f.
Mat3 stretch_hessian(double stiffness, const Vec3& f) {
  const double length = std::sqrt(f.squaredNorm() + kMembraneLeastLengthSquared);
  return stiffness * ((1 - 1 / length) * Mat3::Identity() + f * f.transpose() / (length * length * length));
}

// D = |fu|^2 |fv|^2 - (fu.fv)^2: its gradient and Hessian by (fu, fv).
Vec6 gram_gradient(const Vec3& fu, const Vec3& fv) {
  const double uu = fu.squaredNorm(), vv = fv.squaredNorm(), uv = fu.dot(fv);
  return stacked(2 * (vv * fu - uv * fv), 2 * (uu * fv - uv * fu));
}

Mat6 gram_hessian(const Vec3& fu, const Vec3& fv) {
  Mat6 hessian;
  const Mat3 identity = Mat3::Identity();
  hessian.topLeftCorner<3, 3>() = 2 * (fv.squaredNorm() * identity - fv * fv.transpose());
  hessian.bottomRightCorner<3, 3>() = 2 * (fu.squaredNorm() * identity - fu * fu.transpose());
  hessian.topRightCorner<3, 3>() = 2 * (2 * fu * fv.transpose() - fv * fu.transpose() - fu.dot(fv) * identity);
  hessian.bottomLeftCorner<3, 3>() = hessian.topRightCorner<3, 3>().transpose();
  return hessian;
}

// Of ks |F - R|^2 / 2 = ks (|fu|^2 + |fv|^2 + 2 - 2 T) / 2 with T^2 = a = |fu|^2 + |fv|^2 + 2 d, d^2 = D + collapse.
Mat6 shear_hessian(double stiffness, const Vec3& fu, const Vec3& fv) {
  const double uu = fu.squaredNorm(), vv = fv.squaredNorm(), uv = fu.dot(fv);
  const double d = std::sqrt(std::max(uu * vv - uv * uv, 0.0) + kMembraneCollapse), a = uu + vv + 2 * d;
  const Vec6 gram = gram_gradient(fu, fv);
  const Mat6 d_hessian = gram_hessian(fu, fv) / (2 * d) - gram * gram.transpose() / (4 * d * d * d);
  const Vec6 a_gradient = 2 * stacked(fu, fv) + gram / d;
  const double t = std::sqrt(a);
  const Mat6 t_hessian =
      (2 * Mat6::Identity() + 2 * d_hessian) / (2 * t) - a_gradient * a_gradient.transpose() / (4 * a * t);
  return stiffness * (Mat6::Identity() - t_hessian);
}

Mat6 element_hessian(const Fabric& fabric, const Vec3& fu, const Vec3& fv) {
  Mat6 hessian = shear_hessian(fabric.shear_stiffness, fu, fv);
  hessian.topLeftCorner<3, 3>() += stretch_hessian(fabric.weft_stiffness, fu);
  hessian.bottomRightCorner<3, 3>() += stretch_hessian(fabric.warp_stiffness, fv);
  return hessian;
}

}  // namespace

void add_membrane_hessian(const Cloth& cloth, const Points3& nodes, Curvature curvature, BlockHessian& hessian) {
  for (const TriangleBlock& block : cloth.blocks)
    for (Eigen::Index l = 0; l < kLanes; ++l) {
      if (block.area[l] == 0) continue;
      const double u[3] = {-block.u1[l] - block.u2[l], block.u1[l], block.u2[l]};
      const double v[3] = {-block.v1[l] - block.v2[l], block.v1[l], block.v2[l]};
      int node[3];
      Vec3 fu = Vec3::Zero(), fv = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        node[k] = block.node[k][static_cast<std::size_t>(l)];
        fu += u[k] * nodes.row(node[k]).transpose();
        fv += v[k] * nodes.row(node[k]).transpose();
      }
      Mat6 h = block.area[l] * element_hessian(cloth.fabric, fu, fv);
      if (curvature == Curvature::Projected) h = without_negative_curvature<6>(h);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          hessian.add(node[i], node[j],
                      u[i] * u[j] * h.topLeftCorner<3, 3>() + u[i] * v[j] * h.topRightCorner<3, 3>() +
                          v[i] * u[j] * h.bottomLeftCorner<3, 3>() + v[i] * v[j] * h.bottomRightCorner<3, 3>());
    }
}

void add_bending_hessian(const Cloth& cloth, BlockHessian& hessian) {
  for (int j = 0; j < cloth.bending.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(cloth.bending, j); it; ++it)
      if (it.index() >= j) hessian.add(static_cast<int>(it.index()), j, it.value() * Mat3::Identity());
}

Mat3 contact_hessian(double stiffness, double depth, double linear_beyond, const Vec3& normal, const Mat3& bend,
                     Curvature curvature) {
  double slope = 0;
  contact_profile(depth, linear_beyond, slope);
  const double rise = depth > 0 && depth < linear_beyond ? 1.0 : 0.0;
  const Mat3 hessian = stiffness * (rise * normal * normal.transpose() - slope * bend);
  return curvature == Curvature::Projected ? without_negative_curvature<3>(hessian) : hessian;
}

Mat3 friction_hessian(double load, double slip_length, const Vec3& slip, const Vec3& normal) {
  double slope_over_length = 0;
  const double length = slip.norm();
  friction_profile(length, slip_length, slope_over_length);
  Mat3 hessian = slope_over_length * (Mat3::Identity() - normal * normal.transpose());
  if (length == 0) return load * hessian;
  const double second = length < slip_length ? 2 * (1 - length / slip_length) / slip_length : 0.0;
  hessian += (second - slope_over_length) / (length * length) * slip * slip.transpose();
  return load * hessian;
}

}  // namespace toile
