// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_tape.h"

#include <algorithm>

#include "engine/bodies/body_slices.h"
#include "engine/bodies/measure_arm.h"
#include "engine/geometry/convex_hull.h"

namespace toile {
namespace {

// Bounds and steps as in measure_body.
constexpr double kThighBelow = 0.03, kFineStep = 0.002, kLevelStep = 0.001;  // m
constexpr double kUnderbust = 0.033, kNeckSpread = 0.005;                    // of the height
constexpr double kNeckLow = -0.025, kNeckHigh = 0.02;                        // of the height, from half way up the neck
// From crotch to armpit. Narrower than measure_body's, so that each girth stays with the rows that answer for it: its
// full measurements correct the difference.
constexpr double kHipHigh = 0.33, kBellyLow = 0.40, kBellyHigh = 0.60, kWaistLow = 0.45, kWaistHigh = 0.70,
                 kChestLow = 0.85;
constexpr double kCalfLow = 0.25, kCalfHigh = 0.55, kKnee = 0.61;  // of the crotch height

struct Level {
  double y, girth;
};

class QuickTape {
 public:
  QuickTape(const TriangleMesh& surface, Skeleton& skeleton)
      : s_(skeleton), slices_(surface, false), armpit_(armpit()) {}

  Measurements run(double bust_y) {
    const double crotch = s_.crotch_y, trunk = armpit_ - crotch;
    const auto middle = [&](double y) { return slices_.middle_girth(y); };
    const auto leg = [&](double y) { return hull_perimeter(slices_.leg(y, Left)); };
    const auto on_trunk = [&](double low, double high, double sign) {
      return extreme(crotch + low * trunk, crotch + high * trunk, sign, middle).girth;
    };
    const Level neck = extreme(s_.neck_y + kNeckLow * s_.height, s_.neck_y + kNeckHigh * s_.height, -1.0, middle);
    s_.neck_y = neck.y;
    return {{"height", s_.height},
            {"inside_leg_length", crotch},
            {"hip_girth", on_trunk(0.0, kHipHigh, 1.0)},
            {"waist_girth", on_trunk(kWaistLow, kWaistHigh, -1.0)},
            {"belly_girth", on_trunk(kBellyLow, kBellyHigh, 1.0)},
            {"chest_girth", on_trunk(kChestLow, 1.0, 1.0)},
            {"bust_girth", middle(bust_y)},
            {"underbust_girth", middle(bust_y - kUnderbust * s_.height)},
            {"neck_girth", neck.girth},
            {"thigh_girth", leg(crotch - kThighBelow)},
            {"knee_girth", leg(kKnee * crotch)},
            {"calf_girth", extreme(kCalfLow * crotch, kCalfHigh * crotch, 1.0, leg).girth}};
  }

 private:
  // Highest level at which the arm is apart from the trunk, by halving.
  double armpit() const {
    double apart = s_.armpit_y - 0.02 * s_.height, grown = s_.armpit_y + 0.02 * s_.height;
    while (grown - apart > kLevelStep) {
      const double y = 0.5 * (apart + grown);
      (slices_.arm_apart(y, Left) ? apart : grown) = y;
    }
    return apart;
  }

  // The largest (sign 1) or least (sign -1) girth between two levels: in coarse steps, then finely around the best.
  template <class GirthAt>
  static Level extreme(double low, double high, double sign, const GirthAt& girth) {
    constexpr double kCoarse = 6.0 * kFineStep;
    Level best{low, 0.0};
    const auto look = [&](double y) {
      const double length = girth(std::clamp(y, low, high));
      if (length > 0.0 && (best.girth == 0.0 || sign * length > sign * best.girth)) best = {y, length};
    };
    for (double y = low; y < high + kCoarse; y += kCoarse) look(y);
    const double middle = best.y;
    for (double step = -kCoarse + kFineStep; step < kCoarse - 0.5 * kFineStep; step += kFineStep) look(middle + step);
    return best;
  }

  Skeleton& s_;
  BodySlices slices_;
  double armpit_;
};

}  // namespace

Measurements measure_mannequin(const TriangleMesh& surface, const Triangles& left_arm, Skeleton& skeleton,
                               double bust_y) {
  Measurements taken = QuickTape(surface, skeleton).run(bust_y);
  const ArmGirths arm = measure_arm({surface.vertices, left_arm}, skeleton.arms[Left]);
  taken["upper_arm_girth"] = arm.upper_arm;
  taken["wrist_girth"] = arm.wrist;
  return taken;
}

double trunk_girth(const TriangleMesh& surface, const Skeleton& skeleton, double t) {
  return BodySlices(surface, false).middle_girth(skeleton.crotch_y + t * (skeleton.armpit_y - skeleton.crotch_y));
}

}  // namespace toile
