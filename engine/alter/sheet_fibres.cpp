// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sheet_fibres.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kShear = 5.0 * kRadianPerDegree;  // kept pieces are isometric only if shear is held too
const double kSineOfShear = std::sin(kShear);
constexpr double kQuarter = 0.5 * std::numbers::pi;

Vec2 turned(const Vec2& v, double angle) {
  return Eigen::Rotation2Dd(angle) * v;
}

}  // namespace

Vec2 wanted_lengths(const Mat2& guide, bool folded) {
  const Vec2 length = guide.colwise().norm().transpose();
  return length.cwiseMin(folded ? 5.0 : 1.0).cwiseMax(0.2);
}

Mat2 fibre_projection(const Mat2& gradient, const Vec2& length, double shear_kept) {
  Vec2 u = gradient.col(0), v = gradient.col(1);
  if (u.norm() < 1e-9) u = Vec2(v.y(), -v.x());
  if (v.norm() < 1e-9) v = Vec2(-u.y(), u.x());
  if (u.norm() < 1e-9) return Mat2(length.asDiagonal());
  u.normalize();
  v.normalize();
  Mat2 shape;
  shape << u * length[0], v * length[1];
  const double across = u.x() * v.y() - u.y() * v.x(), along = u.dot(v);
  const bool within = across > 0.0 && std::abs(along) <= kSineOfShear;
  if (within && shear_kept == 1.0) return shape;  // fibres as they lie: no turn brings it nearer
  // What of the shear is not kept both fibres turn back half each, and all of it to where it is nearest.
  const double shear = within ? -std::asin(along) : std::atan2(across, along) - kQuarter;
  const double back = 0.5 * (shear - shear_kept * std::clamp(shear, -kShear, kShear));
  shape << turned(shape.col(0), back), turned(shape.col(1), -back);
  const double c = gradient.cwiseProduct(shape).sum(),
               s = gradient.row(1).dot(shape.row(0)) - gradient.row(0).dot(shape.row(1)),
               norm = std::sqrt(c * c + s * s);
  if (norm < 1e-12) return shape;
  return (Mat2() << c, -s, s, c).finished() / norm * shape;
}

}  // namespace toile
