// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_slices.h"

#include <algorithm>

#include "engine/geometry/convex_hull.h"

namespace toile {
namespace {

// Fractions of the height.
constexpr double kMergeWithin = 0.004;    // pieces whose boxes are nearer are one broken outline
constexpr double kMiddle = 0.004;         // a piece that reaches this near to x = 0 spans the mid-plane
constexpr double kThicknessBand = 0.008;  // half width about the mid-plane
constexpr double kLegReach = 0.20;        // a leg's middle is at most this far to the side; hands are further
constexpr double kCentral = 0.02;         // a piece with its middle this near to x = 0 lies on the mid-plane
constexpr double kLimbGirth = 0.08;       // thinner pieces are fingers, specks or folds
constexpr double kGapSought = 0.15;       // under the armpit
constexpr double kGapStep = 0.002;        // m

bool spans_middle(const SliceComponent& c, double within) {
  return c.low.x() <= within && c.high.x() >= -within;
}

// Highest level under the armpit, mean of both sides, at which the arm is this far from the trunk, m.
std::optional<double> gap_level(const BodySlices& slices, double armpit, double width) {
  double sum = 0.0;
  for (const Side side : {Left, Right}) {
    double above = armpit, last = 0.0, y = above;
    while (last < width && y > armpit - kGapSought * slices.height()) {
      above = y, y -= kGapStep;
      const double gap = slices.arm_gap(y, side).value_or(0.0);
      if (gap >= width) sum += 0.5 * (y + (above - y) * (gap - width) / (gap - last));
      last = gap;
    }
    if (last < width) return std::nullopt;
  }
  return sum;
}

}  // namespace

BodySlices::BodySlices(const TriangleMesh& body, bool broken)
    : slicer_(body), height_(std::max(slicer_.top(), 1e-6)), merge_within_(broken ? kMergeWithin * height_ : -1.0) {}

std::vector<SliceComponent> BodySlices::pieces(double y) const {
  return slicer_.slice(y, merge_within_);
}

std::optional<SliceComponent> BodySlices::middle(double y) const {
  std::optional<SliceComponent> trunk;
  for (SliceComponent& c : pieces(y)) {
    if (!spans_middle(c, kMiddle * height_)) continue;
    if (trunk)
      trunk->add(c);
    else
      trunk = std::move(c);
  }
  return trunk;
}

double BodySlices::middle_girth(double y) const {
  const auto c = middle(y);
  return c ? c->hull_girth() : 0.0;
}

std::vector<Vec2> BodySlices::leg(double y, Side side) const {
  std::vector<Vec2> points;
  for (const SliceComponent& c : slicer_.slice(y)) {
    if (std::abs(c.centre().x()) > kLegReach * height_) continue;
    const auto half = side == Left ? c.points(0.0, 1e300) : c.points(-1e300, 0.0);
    points.insert(points.end(), half.begin(), half.end());
  }
  return points;
}

double BodySlices::middle_thickness(double y) const {
  double front = -1e300, back = 1e300;
  for (const SliceComponent& c : slicer_.slice(y)) {
    if (!spans_middle(c, kThicknessBand * height_)) continue;
    for (const Vec2& p : c.points(-kThicknessBand * height_, kThicknessBand * height_))
      front = std::max(front, p.y()), back = std::min(back, p.y());
  }
  return front > back ? front - back : 0.0;
}

bool BodySlices::middle_closed(double y) const {
  double left = 1e300, right = -1e300;  // the inmost points of both sides
  for (const SliceComponent& c : slicer_.slice(y)) {
    const double x = c.centre().x();
    if (std::abs(x) < kCentral * height_) return true;
    x > 0 ? left = std::min(left, c.low.x()) : right = std::max(right, c.high.x());
  }
  return right >= left;
}

std::optional<double> BodySlices::arm_gap(double y, Side side) const {
  const auto trunk = middle(y);
  if (!trunk) return std::nullopt;
  std::optional<double> gap;
  for (const SliceComponent& c : pieces(y)) {
    const double apart = side == Left ? c.low.x() - trunk->high.x() : trunk->low.x() - c.high.x();
    if (apart > 0 && c.hull_girth() > kLimbGirth * height_) gap = std::min(apart, gap.value_or(apart));
  }
  return gap;
}

bool BodySlices::arm_apart(double y, Side side) const {
  return arm_gap(y, side).has_value();
}

std::optional<double> arms_meet(const BodySlices& slices, double armpit, double narrow, double wide) {
  const auto low = gap_level(slices, armpit, wide * slices.height()),
             high = gap_level(slices, armpit, narrow * slices.height());
  if (!low || !high) return std::nullopt;
  return *high + (*high - *low) * narrow / (wide - narrow);
}

}  // namespace toile
