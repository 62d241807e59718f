// SPDX-License-Identifier: GPL-3.0-or-later
// Where the rows of a mannequin's cage lie along the body, and by how much each is scaled. Lengths in body heights.
#pragma once

#include <array>

#include "engine/bodies/mannequin_shape.h"
#include "engine/bodies/mannequin_tables.h"

namespace toile {

// Heights of the rows between crotch (0) and armpit (1), and of the leg's between crotch (0) and sole (1).
inline constexpr std::array<double, 9> kTrunkRows = {0.06, 0.19, 0.32, 0.45, 0.57, 0.69, 0.80, 0.91, 1.0};
inline constexpr std::array<double, 10> kLegRows = {0.05, 0.15, 0.26, 0.34, 0.40, 0.47, 0.56, 0.67, 0.78, 0.87};

struct MannequinLevels {
  double crotch, armpit, neck, head;  // neck: half way up; head: the middle its rays start from
  double on_trunk(double t) const { return crotch + t * (armpit - crotch); }
};

MannequinLevels mannequin_levels(const MannequinShape& shape);

// Scale of the head's rays at this elevation: skull above, face below.
double head_scale(const MannequinShape& shape, double elevation);

// Unit vector; azimuth from the front to the left, elevation upwards, degrees.
Vec3 ray(double azimuth, double elevation);

double trunk_axis_z(const MannequinShape& shape, std::size_t row);
double shoulder_axis_z(const MannequinShape& shape);
double neck_axis_z(const MannequinShape& shape);
double head_axis_z(const MannequinShape& shape);
Vec3 leg_axis(const MannequinShape& shape, std::size_t row);

double trunk_factor(const MannequinShape& shape, double t);     // t as in kTrunkRows
double shoulder_factor(const MannequinShape& shape, double t);  // 0 at the armpit, 1 at the neck's base
double leg_factor(const MannequinShape& shape, double s);       // s as in kLegRows

template <int Rows, int Columns>
double fan_radius(const mannequin_tables::Fan<Rows, Columns>& fan, std::size_t row, std::size_t column,
                  const MannequinShape& shape) {
  return 1e-3 * (fan.mean[row][column] + shape.sex * fan.sex[row][column] + shape.fatness * fan.fatness[row][column]);
}

}  // namespace toile
