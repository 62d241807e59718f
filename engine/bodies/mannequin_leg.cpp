// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/bodies/mannequin_limbs.h"
#include "engine/bodies/mannequin_rows.h"
#include "engine/bodies/mannequin_tables.h"
#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kAzimuthStep = 36.0, kFirstAzimuth = -54.0;  // degrees; the bridge lies at -90, inside
constexpr double kLeastGap = 0.0015;                          // of the inner thigh from the midline

// One ring of the foot, from the top of the instep to the sole; relative to the ankle, heel backwards.
struct FootRing {
  double top_y, top_z, sole_y, sole_z, half_width, inward;  // inward: shift of the ring towards the midline
  double skew;                                              // how much further its inner side lies than its outer
};
constexpr std::array<FootRing, 8> kFoot = {{{.0530, .0275, .0445, -.0265, .0180, .000, .000},
                                            {.0475, .0350, .0270, -.0330, .0182, .000, .000},
                                            {.0425, .0440, .0100, -.0325, .0188, .000, .000},
                                            {.0380, .0550, .0000, -.0150, .0195, .000, .000},
                                            {.0330, .0685, .0000, .0200, .0210, .001, .002},
                                            {.0270, .0830, .0000, .0540, .0245, .002, .006},
                                            {.0215, .0980, .0000, .0840, .0262, .003, .010},
                                            {.0165, .1120, .0000, .1080, .0235, .004, .016}}};
constexpr double kToeFront = .1190, kToeHeight = .0075;

double squared_off(double value) {
  return std::copysign(std::pow(std::abs(value), 0.8), value);
}

class FootPlacer {
 public:
  // `swelling`: of the leg's last ring against an average one.
  FootPlacer(const MannequinShape& shape, const MannequinCage& cage, const Vec3& ankle, double swelling,
             Points3& points)
      : size_(shape.foot_length),
        rise_(mannequin_levels(shape).crotch / kUsualCrotch * std::min(shape.foot_length, 1.15)),
        swelling_(swelling),
        ankle_(ankle),
        cage_(cage),
        points_(points) {}

  void place() {
    constexpr std::array<double, 4> kSwollen = {0.8, 0.45, 0.2,
                                                0.05};  // how much of the ankle's swelling a ring shares
    for (std::size_t r = 0; r < kFoot.size(); ++r)
      ring(cage_.foot[r], kFoot[r], r < kSwollen.size() ? 1.0 + kSwollen[r] * (swelling_ - 1.0) : 1.0);
    const FootRing& last = kFoot.back();
    for (std::size_t k = 0; k < 2; ++k) {
      const double side = k == 0 ? -0.4 : 0.4;
      put(cage_.toe[k], side * last.half_width - last.inward, kToeHeight, kToeFront - 0.5 * side * last.skew);
    }
  }

 private:
  void ring(const CageRow<10>& row, const FootRing& shape, double wider) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double azimuth = (kFirstAzimuth + kAzimuthStep * static_cast<double>(i)) * kRadianPerDegree;
      const double up = 0.5 * (1.0 + squared_off(std::cos(azimuth))), side = squared_off(std::sin(azimuth));
      const double z = wider * (shape.sole_z + up * (shape.top_z - shape.sole_z)) - 0.5 * shape.skew * side;
      put(row[i], wider * side * shape.half_width - shape.inward, shape.sole_y + up * (shape.top_y - shape.sole_y), z);
    }
  }

  void put(int point, double x, double y, double z) {
    constexpr double kTurnOut = 7.0 * kRadianPerDegree;
    const Vec3 forward(std::sin(kTurnOut), 0.0, std::cos(kTurnOut)),
        outward(std::cos(kTurnOut), 0.0, -std::sin(kTurnOut));
    const Vec3 position = ankle_ + size_ * (x * outward + z * forward);
    points_.row(point) << position.x(), y * rise_, position.z();
  }

  static constexpr double kUsualCrotch = 0.467;  // of the height, of whom the rings were drawn
  const double size_, rise_, swelling_;
  const Vec3 ankle_;
  const MannequinCage& cage_;
  Points3& points_;  // in body heights
};

}  // namespace

void place_leg(const MannequinShape& shape, const MannequinCage& cage, Points3& points) {
  constexpr double kPressed = 0.96;  // of the inner radius: how far thighs that touch flatten each other
  constexpr double kSexRadius = -0.05, kFatRadius = 0.08;  // relative, of every row: the tables hold only the mean
  Vec3 ankle = Vec3::Zero();
  const double general = 1.0 + kSexRadius * shape.sex + kFatRadius * shape.fatness;
  // Thighs do not stand out sideways from the hip above them; further down the legs may stand apart.
  constexpr double kApart = 0.07;  // of the way down from the crotch
  const double hip = std::max(points(cage.trunk[0][4], 0), points(cage.trunk[1][4], 0));
  constexpr std::size_t kOutside = 4;  // column
  for (std::size_t r = 0; r < cage.leg.size(); ++r) {
    Vec3 axis = leg_axis(shape, r);
    const auto& table = mannequin_tables::kLeg[r];
    const double factor = leg_factor(shape, kLegRows[r]) * 1e-3 * general;
    const double widest = hip + kApart * (mannequin_levels(shape).crotch - axis.y());
    axis.x() = std::min(axis.x(), widest - factor * table[kOutside]);
    axis.x() = std::max(axis.x(), kPressed * factor * table.back() + kLeastGap);
    for (std::size_t i = 0; i < 10; ++i) {
      const double azimuth = kFirstAzimuth + kAzimuthStep * static_cast<double>(i);
      Vec3 position = axis + factor * table[i] * ray(azimuth, 0.0);
      position.x() = std::clamp(position.x(), kLeastGap, widest);
      points.row(cage.leg[r][i]) = position.transpose();
    }
    ankle = axis;
  }
  FootPlacer(shape, cage, ankle, general * leg_factor(shape, kLegRows.back()), points).place();
}

}  // namespace toile
