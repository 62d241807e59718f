// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/stages/mannequin_limbs.h"
#include "engine/stages/mannequin_rows.h"
#include "engine/stages/mannequin_tables.h"

namespace toile {
namespace {

constexpr double kAzimuthStep = 36.0, kFirstAzimuth = -54.0;  // degrees; the bridge lies at -90, inside
constexpr double kLeastGap = 0.0015;                          // of the inner thigh from the midline

// One ring of the foot, from the top of the instep to the sole; relative to the ankle, heel backwards.
struct FootRing {
  double top_y, top_z, sole_y, sole_z, half_width, inward;  // inward: shift of the ring towards the midline
};
constexpr std::array<FootRing, 8> kFoot = {{{.046, .024, .040, -.026, .0185, .000},
                                            {.046, .034, .022, -.034, .0190, .000},
                                            {.044, .046, .006, -.031, .0195, .000},
                                            {.038, .060, .000, -.010, .0205, .000},
                                            {.030, .075, .000, .022, .0220, .001},
                                            {.021, .090, .000, .052, .0255, .002},
                                            {.015, .103, .000, .080, .0265, .003},
                                            {.011, .114, .001, .106, .0215, .005}}};

double squared_off(double value) {
  return std::copysign(std::pow(std::abs(value), 0.8), value);
}

void place_foot(const MannequinShape& shape, const MannequinCage& cage, const Vec3& ankle, Points3& points) {
  constexpr double kTurnOut = 7.0 * kRadianPerDegree;
  const double size = shape.foot_length;
  const auto place = [&](int point, double x, double y, double z) {
    const Vec3 forward(std::sin(kTurnOut), 0.0, std::cos(kTurnOut)),
        outward(std::cos(kTurnOut), 0.0, -std::sin(kTurnOut));
    const Vec3 position = Vec3(ankle.x(), 0.0, ankle.z()) + size * (x * outward + z * forward);
    points.row(point) << position.x(), y * std::min(size, 1.15), position.z();
  };
  for (std::size_t r = 0; r < kFoot.size(); ++r) {
    const FootRing& ring = kFoot[r];
    for (std::size_t i = 0; i < 10; ++i) {
      const double azimuth = (kFirstAzimuth + kAzimuthStep * static_cast<double>(i)) * kRadianPerDegree;
      const double up = 0.5 * (1.0 + squared_off(std::cos(azimuth)));
      const double x = squared_off(std::sin(azimuth)) * ring.half_width - ring.inward;
      place(cage.foot[r][i], x, ring.sole_y + up * (ring.top_y - ring.sole_y),
            ring.sole_z + up * (ring.top_z - ring.sole_z));
    }
  }
  for (std::size_t k = 0; k < 2; ++k) place(cage.toe[k], k == 0 ? -.014 : .003, .006, k == 0 ? .118 : .116);
}

}  // namespace

void place_leg(const MannequinShape& shape, const MannequinCage& cage, Points3& points) {
  constexpr double kPressed = 0.96;  // of the inner radius: how far thighs that touch flatten each other
  constexpr double kSexRadius = -0.05, kFatRadius = 0.08;  // relative, of every row: the tables hold only the mean
  const double general = 1.0 + kSexRadius * shape.sex + kFatRadius * shape.fatness;
  // Thighs do not stand out sideways from the hip above them.
  const double widest = std::max(points(cage.trunk[0][4], 0), points(cage.trunk[1][4], 0));
  for (std::size_t r = 0; r < cage.leg.size(); ++r) {
    Vec3 axis = leg_axis(shape, r);
    const double factor = leg_factor(shape, kLegRows[r]) * 1e-3 * general;
    axis.x() = std::max(axis.x(), kPressed * factor * mannequin_tables::kLeg[r].back() + kLeastGap);
    for (std::size_t i = 0; i < 10; ++i) {
      const double azimuth = kFirstAzimuth + kAzimuthStep * static_cast<double>(i);
      Vec3 position = axis + factor * mannequin_tables::kLeg[r][i] * ray(azimuth, 0.0);
      position.x() = std::clamp(position.x(), kLeastGap, widest);
      points.row(cage.leg[r][i]) = position.transpose();
    }
  }
  place_foot(shape, cage, leg_axis(shape, cage.leg.size() - 1), points);
}

}  // namespace toile
