// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/measure_body.h"

#include <algorithm>

#include "engine/bodies/body_slices.h"
#include "engine/bodies/find_landmarks.h"
#include "engine/bodies/measure_arm.h"
#include "engine/bodies/measure_neck.h"
#include "engine/geometry/convex_hull.h"

namespace toile {
namespace {

constexpr double kFineStep = 0.001;   // m
constexpr double kLevelStep = 0.002;  // m, at most, between slices when the largest or least girth is sought
constexpr double kThighBelow = 0.03;  // m under the crotch
// Fractions of the height: how far the crotch is sought from the skeleton's.
constexpr double kCrotchBelow = 0.02, kCrotchAbove = 0.012;
constexpr double kJointUnder = 0.03;  // the joint of the shoulder, under its point on the skin
constexpr double kUnderbust = 0.033;  // of the height under the bust points
// Fractions of the way from crotch to armpit.
constexpr double kHipHigh = 0.40, kWaistLow = 0.40, kWaistHigh = 0.75, kChestLow = 2.0 / 3.0;

struct Girth {
  double y = 0.0, length = 0.0;
};

// Only near the skeleton's crotch: thighs that touch further down are not the trunk.
double lowest_closed_level(const BodySlices& slices, const Skeleton& skeleton) {
  const double h = slices.height();
  double y = skeleton.crotch_y - kCrotchBelow * h;
  while (y < skeleton.crotch_y + kCrotchAbove * h && !slices.middle_closed(y)) y += kFineStep;
  return y;
}

class Tape {
 public:
  Tape(const TriangleMesh& body, const Skeleton& skeleton)
      : body_(body), s_(skeleton), slices_(body, false), h_(slices_.height()) {}

  MeasureBodyResult run(const Landmarks& given) {
    const auto crotch = given.find("crotch");
    levels_.crotch = crotch == given.end() ? lowest_closed_level(slices_, s_) : crotch->second.y();
    levels_.armpit = armpit();
    result_.landmarks = find_landmarks(body_, s_, slices_, levels_);
    for (const auto& [name, point] : given) result_.landmarks[name] = point;
    measure_trunk();
    measure_legs();
    measure_arms();
    return std::move(result_);
  }

 private:
  void set(const char* name, double value) { result_.measurements[name] = value; }
  const Vec3& landmark(const char* name) const { return result_.landmarks.at(name); }

  // Highest level at which both arms are apart from the trunk.
  double armpit() const {
    double y = s_.armpit_y + 0.02 * h_;
    while (y > s_.armpit_y - 0.02 * h_ && !(slices_.arm_apart(y, Left) && slices_.arm_apart(y, Right))) y -= kFineStep;
    return y;
  }

  // The largest (sign 1) or least (sign -1) girth of the trunk between two levels, both of them included.
  Girth extreme_girth(double low, double high, double sign) const {
    Girth best;
    const int steps = std::max(1, static_cast<int>(std::ceil((high - low) / kLevelStep)));
    for (int i = 0; i <= steps; ++i) {
      const double y = low + (high - low) * i / steps;
      const double length = slices_.middle_girth(y);
      if (length > 0 && (best.length == 0 || sign * length > sign * best.length)) best = {y, length};
    }
    return best;
  }

  void measure_trunk() {
    const double trunk = levels_.armpit - levels_.crotch;
    const auto level = [&](double fraction) { return levels_.crotch + fraction * trunk; };
    set("height", h_);
    set("inside_leg_length", levels_.crotch);
    const auto take = [&](const char* name, double& y, const Girth& girth) {
      y = girth.y;
      set(name, girth.length);
    };
    double belly = 0.0;
    take("hip_girth", levels_.hip, extreme_girth(level(0), level(kHipHigh), 1));
    take("waist_girth", levels_.waist, extreme_girth(level(kWaistLow), level(kWaistHigh), -1));
    take("belly_girth", belly, extreme_girth(level(kWaistLow), level(kWaistHigh), 1));
    take("chest_girth", levels_.chest, extreme_girth(level(kChestLow), level(1), 1));
    const NeckGirth neck = measure_neck(body_, s_);
    take("neck_girth", levels_.neck, {neck.y, neck.length});
    levels_.bust = 0.5 * (landmark("bust_l").y() + landmark("bust_r").y());
    levels_.underbust = levels_.bust - kUnderbust * h_;
    set("bust_girth", slices_.middle_girth(levels_.bust));
    set("underbust_girth", slices_.middle_girth(levels_.underbust));
    set("shoulder_width", (landmark("shoulder_l") - landmark("shoulder_r")).norm());
  }

  double leg_girth(double y, Side side) const { return hull_perimeter(slices_.leg(y, side)); }

  void measure_legs() {
    levels_.thigh = levels_.crotch - kThighBelow;
    double thigh[2], knee[2], calf[2];
    for (const Side side : {Left, Right}) {
      levels_.knee = landmark(side == Left ? "knee_l" : "knee_r").y();
      thigh[side] = leg_girth(levels_.thigh, side);
      knee[side] = leg_girth(levels_.knee, side);
      Girth most;
      for (double y = 0.25 * levels_.crotch; y < 0.55 * levels_.crotch; y += kLevelStep)
        if (const double length = leg_girth(y, side); length > most.length) most = {y, length};
      calf[side] = most.length;
      levels_.calf = most.y;
    }
    set("thigh_girth_left", thigh[Left]);
    set("thigh_girth_right", thigh[Right]);
    set("thigh_girth", 0.5 * (thigh[Left] + thigh[Right]));
    set("knee_girth", 0.5 * (knee[Left] + knee[Right]));
    set("calf_girth", 0.5 * (calf[Left] + calf[Right]));
  }

  void measure_arms() {
    double upper = 0.0, wrist = 0.0, length = 0.0;
    for (const Side side : {Left, Right}) {
      const char* mark = side == Left ? "_l" : "_r";
      const auto point = [&](const char* name) { return result_.landmarks.at(std::string(name) + mark); };
      Skeleton::Arm arm = s_.arms[side];
      arm.shoulder = point("shoulder") - Vec3(0, kJointUnder * h_, 0);
      const ArmGirths girths = measure_arm(body_, arm);
      upper += 0.5 * girths.upper_arm, wrist += 0.5 * girths.wrist;
      length += 0.5 * ((point("shoulder") - point("elbow")).norm() + (point("elbow") - point("wrist")).norm());
    }
    set("upper_arm_girth", upper);
    set("wrist_girth", wrist);
    set("arm_length", length);
  }

  const TriangleMesh& body_;
  const Skeleton& s_;
  BodySlices slices_;
  double h_;
  MeasureBodyResult result_;
  MeasuringLevels& levels_ = result_.levels;
};

}  // namespace

double find_crotch_level(const TriangleMesh& body, const Skeleton& skeleton) {
  return lowest_closed_level(BodySlices(body, false), skeleton);
}

MeasureBodyResult measure_body(const TriangleMesh& body, const Skeleton& skeleton, const Landmarks& given) {
  return Tape(body, skeleton).run(given);
}

}  // namespace toile
