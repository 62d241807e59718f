// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include "engine/bodies/mannequin_limbs.h"
#include "engine/bodies/mannequin_rows.h"
#include "engine/core/units.h"

namespace toile {
namespace {

struct ArmRing {
  double distance, tilt, half_height, half_depth;  // tilt: how much the top lies nearer to the shoulder
};
// Distances from the armpit along the upper arm, then from the elbow along the forearm.
constexpr std::array<ArmRing, 4> kUpperArm = {
    {{.020, .036, .0277, .0300}, {.052, .016, .0283, .0308}, {.090, .004, .0265, .0285}, {.132, .000, .0228, .0245}}};
constexpr std::array<ArmRing, 4> kForearm = {
    {{.030, .0, .0232, .0240}, {.068, .0, .0205, .0208}, {.108, .0, .0160, .0168}, {.146, .0, .0120, .0155}}};
constexpr double kElbow = 0.135, kWrist = 0.150;

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
    const LimbFrame fore = upper.bent(kElbow * length_, 14.0);
    for (std::size_t r = 0; r < 4; ++r) ring(cage_.arm[4 + r], fore, kForearm[r], fore_factor(r));
    place_hand(fore.bent(kWrist * length_, 4.0), length_, std::sqrt(shape_.factor(Girth::Wrist)), cage_, points_);
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

  void ring(const CageRow<10>& row, const LimbFrame& frame, const ArmRing& shape, double factor) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double turn = turn_of(i), above = 0.5 * (1.0 - std::cos(turn * kRadianPerDegree));
      const double distance = (shape.distance - above * shape.tilt) * length_;
      put(row[i], frame.at(distance, turn, shape.half_height * factor, shape.half_depth * factor));
    }
  }

  const MannequinShape& shape_;
  const MannequinCage& cage_;
  Points3& points_;
  const double length_;
};

}  // namespace

Vec3 LimbFrame::at(double distance, double turn, double half_height, double half_depth) const {
  const double t = turn * kRadianPerDegree;
  return origin + distance * along - std::cos(t) * half_height * up - std::sin(t) * half_depth * front;
}

LimbFrame LimbFrame::bent(double distance, double degrees) const {
  const double angle = degrees * kRadianPerDegree;
  LimbFrame frame = *this;
  frame.origin = origin + distance * along;
  frame.along = std::cos(angle) * along + std::sin(angle) * front;
  frame.front = std::cos(angle) * front - std::sin(angle) * along;
  return frame;
}

void place_arm(const MannequinShape& shape, const MannequinCage& cage, Points3& points) {
  ArmPlacer(shape, cage, points).place();
}

}  // namespace toile
