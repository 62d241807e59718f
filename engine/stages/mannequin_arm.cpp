// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include "engine/core/units.h"
#include "engine/stages/mannequin_limbs.h"
#include "engine/stages/mannequin_rows.h"

namespace toile {
namespace {

// Right-handed frame of a straight piece of limb: along it, upwards across it, and to the front across it.
struct LimbFrame {
  Vec3 origin, along, up, front;

  // `turn` runs 0 below, 90 behind, 180 above, 270 in front, degrees.
  Vec3 at(double distance, double turn, double half_height, double half_depth) const {
    const double t = turn * kRadianPerDegree;
    return origin + distance * along - std::cos(t) * half_height * up - std::sin(t) * half_depth * front;
  }
};

struct ArmRing {
  double distance, tilt, half_height, half_depth;  // tilt: how much the top lies nearer to the shoulder
};
// Distances from the armpit along the upper arm, then from the elbow along the forearm, then from the wrist.
constexpr std::array<ArmRing, 4> kUpperArm = {
    {{.020, .036, .0277, .0300}, {.052, .016, .0283, .0308}, {.090, .004, .0265, .0285}, {.132, .000, .0228, .0245}}};
constexpr std::array<ArmRing, 4> kForearm = {
    {{.030, .0, .0232, .0240}, {.068, .0, .0205, .0208}, {.108, .0, .0160, .0168}, {.146, .0, .0120, .0155}}};
constexpr double kElbow = 0.135, kWrist = 0.150;
constexpr std::array<ArmRing, 5> kHand = {{{.016, .0, .0125, .0180},
                                           {.040, .0, .0110, .0235},
                                           {.062, .0, .0090, .0245},
                                           {.084, .0, .0075, .0220},
                                           {.104, .0, .0055, .0150}}};
constexpr double kFingerTip = 0.110;

double turn_of(std::size_t column) {
  return 36.0 * (static_cast<double>(column) - 1.0);
}

class ArmPlacer {
 public:
  ArmPlacer(const MannequinShape& shape, const MannequinCage& cage, Points3& points)
      : shape_(shape), cage_(cage), points_(points), length_(shape.arm_length) {}

  void place() {
    const LimbFrame upper = upper_arm();
    for (std::size_t r = 0; r < 4; ++r) ring(cage_.arm[r], upper, kUpperArm[r], upper_factor(r));
    const LimbFrame fore = bent(upper, kElbow * length_, 14.0);
    for (std::size_t r = 0; r < 4; ++r) ring(cage_.arm[4 + r], fore, kForearm[r], fore_factor(r));
    const LimbFrame hand = bent(fore, kWrist * length_, 4.0);
    const double size = std::sqrt(shape_.factor(Girth::Wrist));
    for (std::size_t r = 0; r < kHand.size(); ++r) ring(cage_.hand[r], hand, kHand[r], size);
    const ArmRing& last = kHand.back();
    for (std::size_t k = 0; k < 2; ++k)
      put(cage_.finger_tip[k], hand.at(kFingerTip * length_, k == 0 ? 0.0 : 180.0, 0.4 * last.half_height, 0.0));
    thumb(hand, size);
  }

 private:
  void put(int point, const Vec3& position) { points_.row(point) = position.transpose(); }
  Vec3 at(int point) const { return points_.row(point).transpose(); }

  double upper_factor(std::size_t r) const {
    const double t = static_cast<double>(r) / 3.0, flesh = 1.0 + 0.10 * shape_.fatness + 0.06 * shape_.sex;
    return flesh * ((1.0 - t) * shape_.factor(Girth::UpperArm) + t * shape_.factor(Girth::Elbow));
  }

  double fore_factor(std::size_t r) const {
    const double t = static_cast<double>(r) / 3.0, flesh = 1.0 + 0.06 * shape_.fatness + 0.05 * shape_.sex;
    return flesh * ((1.0 - t) * shape_.factor(Girth::Elbow) + t * shape_.factor(Girth::Wrist));
  }

  // The arm leaves the trunk so that its underside passes through the armpit, however thick it is.
  LimbFrame upper_arm() const {
    constexpr double kBelowHorizontal = 46.0;  // degrees: the A-pose
    const double angle = kBelowHorizontal * kRadianPerDegree;
    LimbFrame frame;
    frame.along = Vec3(std::cos(angle), -std::sin(angle), 0.0);
    frame.up = Vec3(std::sin(angle), std::cos(angle), 0.0);
    frame.front = Vec3::UnitZ();
    const auto hole = cage_.armhole();
    const Vec3 armpit = at(hole[1]);
    double depth = 0.0;
    for (const int point : hole) depth += points_(point, 2) / static_cast<double>(hole.size());
    frame.origin = armpit + (kUpperArm[0].half_height * upper_factor(0) + 0.001) * frame.up;
    frame.origin.z() = depth;
    return frame;
  }

  static LimbFrame bent(const LimbFrame& upper, double distance, double forward_degrees) {
    const double angle = forward_degrees * kRadianPerDegree;
    LimbFrame frame = upper;
    frame.origin = upper.origin + distance * upper.along;
    frame.along = std::cos(angle) * upper.along + std::sin(angle) * upper.front;
    frame.front = std::cos(angle) * upper.front - std::sin(angle) * upper.along;
    return frame;
  }

  void ring(const CageRow<10>& row, const LimbFrame& frame, const ArmRing& shape, double factor) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double turn = turn_of(i), above = 0.5 * (1.0 - std::cos(turn * kRadianPerDegree));
      const double distance = (shape.distance - above * shape.tilt) * length_;
      put(row[i], frame.at(distance, turn, shape.half_height * factor, shape.half_depth * factor));
    }
  }

  // Grows out of the gap left at the front of the hand.
  void thumb(const LimbFrame& hand, double size) {
    constexpr std::array<double, 3> kOut = {0.012, 0.024, 0.034}, kOn = {0.014, 0.030, 0.046},
                                    kShare = {0.55, 0.5, 0.32};
    const std::array<int, 4> root = {cage_.hand[0][8], cage_.hand[0][9], cage_.hand[1][9], cage_.hand[1][8]};
    Vec3 middle = Vec3::Zero();
    for (const int point : root) middle += 0.25 * at(point);
    for (std::size_t r = 0; r < 3; ++r) {
      const Vec3 centre = middle + size * (kOut[r] * hand.front + kOn[r] * hand.along);
      for (std::size_t i = 0; i < 4; ++i) put(cage_.thumb[r][i], centre + kShare[r] * (at(root[i]) - middle));
    }
  }

  const MannequinShape& shape_;
  const MannequinCage& cage_;
  Points3& points_;
  const double length_;
};

}  // namespace

void place_arm(const MannequinShape& shape, const MannequinCage& cage, Points3& points) {
  ArmPlacer(shape, cage, points).place();
}

}  // namespace toile
