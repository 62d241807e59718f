// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/side_curve.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace toile {
namespace {

Vec2 right_of(const Vec2& way) {
  const double length = way.norm();
  return length > 0.0 ? Vec2(way.y() / length, -way.x() / length) : Vec2::Zero();
}

}  // namespace

SideCurve::SideCurve(std::vector<Vec2> points) : points_(std::move(points)) {
  assert(points_.size() >= 2);
  at_ = {0.0};
  for (std::size_t i = 1; i < points_.size(); ++i) at_.push_back(at_.back() + (points_[i] - points_[i - 1]).norm());
  normals_.assign(points_.size(), Vec2::Zero());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Vec2 normal = right_of(points_[i] - points_[i - 1]);
    normals_[i - 1] += normal;
    normals_[i] += normal;
  }
  for (Vec2& normal : normals_)
    if (normal.norm() > 0.0) normal.normalize();
}

SideFoot SideCurve::closest(const Vec2& p) const {
  SideFoot best;
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t last = points_.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Vec2 way = points_[i + 1] - points_[i];
    const double squared = way.squaredNorm();
    if (squared == 0.0) continue;
    double t = way.dot(p - points_[i]) / squared;
    if (i > 0) t = std::max(t, 0.0);
    if (i + 1 < last) t = std::min(t, 1.0);
    const Vec2 foot = points_[i] + t * way;
    const double distance = (p - foot).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    const double within = std::clamp(t, 0.0, 1.0);
    const Vec2 normal = (1.0 - within) * normals_[i] + within * normals_[i + 1];
    best = {at_[i] + t * std::sqrt(squared), foot, normal.norm() > 0.0 ? normal.normalized() : right_of(way)};
  }
  return best;
}

Vec2 SideCurve::point(double at) const {
  if (at <= 0.0) return points_.front();
  if (at >= length()) return points_.back();
  const auto next = std::upper_bound(at_.begin(), at_.end(), at);
  const auto i = static_cast<std::size_t>(next - at_.begin());
  const double t = (at - at_[i - 1]) / (at_[i] - at_[i - 1]);
  return points_[i - 1] + t * (points_[i] - points_[i - 1]);
}

}  // namespace toile
