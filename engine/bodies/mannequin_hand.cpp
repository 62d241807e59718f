// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "engine/bodies/mannequin_limbs.h"
#include "engine/core/units.h"

namespace toile {
namespace {

// Lengths in body heights, of an average hand: 0.108 from wrist to finger tip, 0.047 broad at the knuckles.
struct PalmRow {
  double distance, half_height, half_depth, round;  // round: 1 an oval, 0 as flat as the fingers' roots ask for
};
constexpr std::array<PalmRow, 4> kPalm = {
    {{.012, .0118, .0172, 1.0}, {.030, .0100, .0215, .8}, {.046, .0084, .0232, .4}, {.059, .0066, .0240, .0}}};
// Of the row at the fingers' roots: how much further each column of the palm lies, from the index's outer side on.
constexpr std::array<double, 5> kKnuckles = {-.0030, .0005, .0010, -.0015, -.0065};

struct Finger {
  double length, spread, half_breadth;  // spread: degrees from the hand's direction, positive to the front
};
constexpr std::array<Finger, 4> kFingers = {
    {{.0425, 6.0, .0041}, {.0475, 1.5, .0042}, {.0440, -3.5, .0040}, {.0345, -9.0, .0035}}};
// Joints of a finger: how far along, how much thinner, and how far each piece is bent towards the palm, degrees.
constexpr std::array<double, 3> kJoint = {.24, .62, .95}, kThinner = {.95, .92, .62}, kCurl = {6.0, 15.0, 24.0};

constexpr std::array<double, 3> kThumbPiece = {.014, .016, .016}, kThumbAngle = {66.0, 40.0, 28.0},
                                kThumbHalf = {.0054, .0048, .0031};  // angle: from the hand's direction to the front

class HandPlacer {
 public:
  HandPlacer(const LimbFrame& frame, double length, double breadth, const MannequinCage& cage, Points3& points)
      : frame_(frame), length_(length), breadth_(breadth), cage_(cage), points_(points) {}

  void place() {
    for (std::size_t r = 0; r < kPalm.size(); ++r) palm_row(cage_.hand[r], kPalm[r]);
    const auto& end = cage_.hand.back();
    for (std::size_t k = 0; k < kFingers.size(); ++k) {
      const int first = k == 0 ? end[9] : end[k - 1];
      finger(cage_.finger[k], 0.25 * (at(first) + at(end[k]) + at(end[7 - k]) + at(end[8 - k])), kFingers[k]);
    }
    thumb();
  }

 private:
  Vec3 at(int point) const { return points_.row(point).transpose(); }
  void put(int point, const Vec3& position) { points_.row(point) = position.transpose(); }
  Vec3 across(double up, double front) const { return breadth_ * (up * frame_.up + front * frame_.front); }

  void palm_row(const CageRow<10>& row, const PalmRow& shape) {
    for (std::size_t column = 0; column < 5; ++column) {
      const double turn = (36.0 * static_cast<double>(column) - 72.0) * kRadianPerDegree;  // 0 in the palm's middle
      const double flat = 1.0 - shape.round;
      const double depth = shape.round * -std::sin(turn) + flat * (1.0 - 0.5 * static_cast<double>(column));
      const double height = shape.round * std::cos(turn) + flat;
      const double distance = (shape.distance + flat * kKnuckles[column]) * length_;
      const Vec3 middle = frame_.origin + distance * frame_.along + across(0.0, depth * shape.half_depth);
      const Vec3 half = across(height * shape.half_height, 0.0);
      put(row[(column + 9) % 10], middle - half);
      put(row[8 - column], middle + half);
    }
  }

  void finger(const std::array<CageRow<4>, 3>& rows, Vec3 joint, const Finger& shape) {
    const double spread = shape.spread * kRadianPerDegree;
    const Vec3 out = std::cos(spread) * frame_.along + std::sin(spread) * frame_.front;
    const Vec3 side = std::cos(spread) * frame_.front - std::sin(spread) * frame_.along;
    double reached = 0.0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double curl = kCurl[r] * kRadianPerDegree;
      const Vec3 along = std::cos(curl) * out - std::sin(curl) * frame_.up;
      const Vec3 up = std::cos(curl) * frame_.up + std::sin(curl) * out;
      joint += (kJoint[r] - reached) * shape.length * length_ * along;
      reached = kJoint[r];
      square(rows[r], joint, kThinner[r] * shape.half_breadth * breadth_, -side, up);
    }
  }

  // Grows out of the gap left at the front of the palm.
  void thumb() {
    const auto &low = cage_.hand[0], &high = cage_.hand[1];
    Vec3 joint = 0.25 * (at(low[8]) + at(low[9]) + at(high[8]) + at(high[9]));
    for (std::size_t r = 0; r < cage_.thumb.size(); ++r) {
      const double angle = kThumbAngle[r] * kRadianPerDegree;
      const Vec3 out = std::cos(angle) * frame_.along + std::sin(angle) * frame_.front;
      const Vec3 on = std::sin(angle) * frame_.along - std::cos(angle) * frame_.front;
      joint += kThumbPiece[r] * (length_ * out - 0.25 * breadth_ * frame_.up);
      square(cage_.thumb[r], joint, kThumbHalf[r] * breadth_, -frame_.up, on);
    }
  }

  // Corners (-a, -b), (a, -b), (a, b), (-a, b) in the order of the root's.
  void square(const CageRow<4>& row, const Vec3& middle, double half, const Vec3& a, const Vec3& b) {
    put(row[0], middle - half * (a + b));
    put(row[1], middle + half * (a - b));
    put(row[2], middle + half * (a + b));
    put(row[3], middle + half * (b - a));
  }

  const LimbFrame& frame_;
  const double length_, breadth_;
  const MannequinCage& cage_;
  Points3& points_;  // in body heights
};

}  // namespace

void place_hand(const LimbFrame& wrist, double length, double breadth, const MannequinCage& cage, Points3& points) {
  HandPlacer(wrist, length, breadth, cage, points).place();
}

}  // namespace toile
