// SPDX-License-Identifier: GPL-3.0-or-later
// One side of a panel's outline as a polyline on which cloth slides. Lengths in metres.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

// A foot point: where along the side, and the frame there.
struct SideFoot {
  double at = 0.0;  // arc length from the side's start; < 0 or > length on the straight continuation past an end
  Vec2 point = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  // unit, to the right of the way along the side: outwards for a counter-clockwise outline
};

class SideCurve {
 public:
  SideCurve() = default;
  // Requires at least two points, not all equal.
  explicit SideCurve(std::vector<Vec2> points);

  // Nearest point of the side, continued straight past both ends.
  SideFoot closest(const Vec2& p) const;
  Vec2 point(double at) const;  // clamped to the side
  double length() const { return at_.back(); }
  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<Vec2>& normals() const { return normals_; }  // per point, as of SideFoot
  const std::vector<double>& at() const { return at_; }          // arc length of every point

 private:
  std::vector<Vec2> points_;
  std::vector<Vec2> normals_;  // per point, mean of its segments': slides without a jolt from segment to segment
  std::vector<double> at_;
};

}  // namespace toile
