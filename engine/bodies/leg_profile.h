// SPDX-License-Identifier: GPL-3.0-or-later
// How a body is shaped from the ankles to the hips, level by level and all round, and which level of one body is which
// of another.
//
// Soles, knee and crotch at fractions of the crotch height put calves, knees and thighs up to 5 cm off: they lie
// otherwise in men than in women, and where thighs press on each other the crotch itself is told too low. What tells
// the levels apart is how the skin leans along the leg (over a calf inward, under it outward; otherwise in front than
// behind) and how far it is from the middle, all round; girth alone does not. Metres, normalised frame.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Both legs and halves of the pelvis together, seen from their own side. One row per level, evenly from kLegLow to
// kLegHigh of the crotch height; one column per sector round the middle. NaN where a scan has a hole in both legs.
struct LegProfile {
  Eigen::MatrixXd lean;    // mean of the normal along the leg's axis, -1..1
  Eigen::MatrixXd radius;  // distance from the middle, as a fraction of its mean over all levels
};
inline constexpr double kLegLow = 0.06, kLegHigh = 1.21;
LegProfile find_leg_profile(const TriangleMesh& body, const Skeleton& skeleton);

// For every level of the reference that of the target, both as fractions of their own crotch heights as find_skeleton
// tells them. Piecewise even, as little stretched as pays (dynamic programming), rising; soles and waist keep theirs.
class LegLevels {
 public:
  LegLevels(const LegProfile& reference, const LegProfile& target);

  double operator()(double level) const;

 private:
  std::vector<double> target_;  // at the profile's levels
};

}  // namespace toile
