// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/trunk_sides.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

constexpr double kByChest = 0.5;      // share of the chest's own lean, from the chest up
constexpr double kChestFrom = 0.5;    // of the way from pelvis to chest: from here up it comes in
constexpr double kLeastDepth = 0.01;  // of the height, from the sides to front or back

double lean_of(const Vec3& up) {
  return std::atan2(up.z(), up.y());
}

}  // namespace

// The ring where an arm meets the trunk is surer than the shoulder, to which the upper arm's direction is prolonged.
TrunkSides::Line::Line(const Skeleton& s)
    : hip_(0.5 * (s.legs[Left].hip + s.legs[Right].hip)),
      armpit_(0.25 * (s.arms[Left].centre_line.bottomRows(2).colwise().sum() +
                      s.arms[Right].centre_line.bottomRows(2).colwise().sum())
                         .transpose()) {}

double TrunkSides::Line::at(double y) const {
  const double up = std::clamp((y - hip_.y()) / (armpit_.y() - hip_.y()), 0.0, 1.0);
  return hip_.z() + up * (armpit_.z() - hip_.z());
}

double TrunkSides::Line::lean() const {
  return lean_of(armpit_ - hip_);
}

TrunkSides::TrunkSides(const BodyProportions& reference, const BodyProportions& target)
    : reference_(reference),
      line_(reference.skeleton),
      target_line_(target.skeleton),
      lean_(target_line_.lean() - line_.lean()),
      chest_lean_(lean_of(target.skeleton.neck - target.skeleton.chest) -
                  lean_of(reference.skeleton.neck - reference.skeleton.chest)) {}

Vec3 TrunkSides::beside(const Vec3& point) const {
  return {point.x(), point.y(), line_.at(point.y())};
}

Vec3 TrunkSides::slide(const Vec3& point, const Vec3& carried) const {
  const Skeleton& s = reference_.skeleton;
  const double up = std::clamp((point.y() - s.pelvis.y()) / (s.chest.y() - s.pelvis.y()), 0.0, 1.0);
  const double by_chest = kByChest * std::clamp((up - kChestFrom) / (1.0 - kChestFrom), 0.0, 1.0);
  const double lean = (1.0 - by_chest) * lean_ + by_chest * chest_lean_;
  return {0.0, -lean * (point.z() - line_.at(point.y())),
          sideways(point, up) * (target_line_.at(carried.y()) - carried.z())};
}

// 1 at the sides of the trunk, 0 in its middle; little under it, between the legs.
double TrunkSides::sideways(const Vec3& point, double up) const {
  const std::size_t n = reference_.trunk_low.size();
  const double level = up * static_cast<double>(n - 1);
  const std::size_t i = std::min(n - 2, static_cast<std::size_t>(level));
  const double t = level - static_cast<double>(i);
  const Vec2 low = (1.0 - t) * reference_.trunk_low[i] + t * reference_.trunk_low[i + 1],
             high = (1.0 - t) * reference_.trunk_high[i] + t * reference_.trunk_high[i + 1];
  const double side = line_.at(point.y()), off = point.z() - side;
  const double depth = std::max(off > 0.0 ? high.y() - side : side - low.y(), kLeastDepth * reference_.skeleton.height);
  const double x = (2.0 * point.x() - low.x() - high.x()) / (high.x() - low.x()), z = off / depth;
  return x * x / std::max(x * x + z * z, 1.0);
}

}  // namespace toile
