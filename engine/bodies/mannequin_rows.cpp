// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_rows.h"

#include <cmath>
#include <initializer_list>

#include "engine/core/units.h"

namespace toile {
namespace {

struct Knot {
  double at, value;
};

// Straight between the knots, level beyond them.
double along(std::initializer_list<Knot> knots, double x) {
  const Knot* before = knots.begin();
  if (x <= before->at) return before->value;
  for (const Knot& knot : knots) {
    if (x <= knot.at) return before->value + (knot.value - before->value) * (x - before->at) / (knot.at - before->at);
    before = &knot;
  }
  return before->value;
}

struct Line {
  double mean, sex, fatness;  // thousandths of body height
  double at(const MannequinShape& shape) const { return 1e-3 * (mean + sex * shape.sex + fatness * shape.fatness); }
};

// Depth of the axis, positive to the front, and its breadth from the midline for the legs. Source: as
// mannequin_tables.h.
constexpr std::array<Line, 9> kTrunkZ = {
    {{-9, 3, 2}, {-10, 3, 2}, {-3, 1, 2}, {7, 1, 1}, {10, -1, 1}, {8, -1, -1}, {3, -2, -2}, {1, -3, -3}, {-7, -1, -2}}};
constexpr double kCrown = 0.0698;  // of an adult, over the middle of the head
constexpr Line kShoulderZ = {-13, 0, -2}, kNeckZ = {1, 4, 0}, kHeadZ = {7, 2, 0};
constexpr std::array<Line, 10> kLegX = {{{60, -2, 1},
                                         {62, 0, 0},
                                         {65, 0, -1},
                                         {68, 0, -1},
                                         {74, 0, -1},
                                         {81, 0, -2},
                                         {84, 0, -2},
                                         {86, 0, -3},
                                         {88, 0, -3},
                                         {87, 0, -4}}};
constexpr std::array<Line, 10> kLegZ = {{{1, -3, 1},
                                         {1, -4, 0},
                                         {-1, -4, -1},
                                         {-2, -4, -2},
                                         {-8, -5, -2},
                                         {-18, -4, -2},
                                         {-23, -3, -2},
                                         {-23, -3, -2},
                                         {-22, -4, -2},
                                         {-19, -3, -2}}};

}  // namespace

double head_scale(const MannequinShape& shape, double elevation) {
  constexpr double kChinBelowMiddle = 0.0587;
  const double skull = shape.head_girth * shape.factor(Girth::Head);
  const double face = (0.129 * shape.head_height - kCrown * skull) / kChinBelowMiddle;
  return along({{-34.0, face}, {14.0, skull}}, elevation);
}

MannequinLevels mannequin_levels(const MannequinShape& shape) {
  const double chin = 1.0 - 0.129 * shape.head_height;  // a child's larger head pushes the shoulders down
  return {.crotch = shape.crotch_height / shape.height,
          .armpit = chin - 0.1184,
          .neck = chin - 0.009,
          .head = 1.0 - kCrown * shape.head_girth * shape.factor(Girth::Head)};
}

Vec3 ray(double azimuth, double elevation) {
  const double a = azimuth * kRadianPerDegree, e = elevation * kRadianPerDegree;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

double trunk_axis_z(const MannequinShape& shape, std::size_t row) {
  return kTrunkZ[row].at(shape);
}
double shoulder_axis_z(const MannequinShape& shape) {
  return kShoulderZ.at(shape);
}
double neck_axis_z(const MannequinShape& shape) {
  return kNeckZ.at(shape);
}
double head_axis_z(const MannequinShape& shape) {
  return kHeadZ.at(shape);
}

Vec3 leg_axis(const MannequinShape& shape, std::size_t row) {
  const double y = mannequin_levels(shape).crotch * (1.0 - kLegRows[row]);
  return {kLegX[row].at(shape), y, kLegZ[row].at(shape)};
}

double trunk_factor(const MannequinShape& shape, double t) {
  return along({{0.19, shape.factor(Girth::Hip)},
                {0.42, shape.factor(Girth::Belly)},
                {0.62, shape.factor(Girth::Waist)},
                {0.80, shape.factor(Girth::Underbust)},
                {0.91, shape.factor(Girth::Bust)},
                {1.00, shape.factor(Girth::Chest)}},
               t);
}

double shoulder_factor(const MannequinShape& shape, double t) {
  const double chest = 0.5 * (shape.factor(Girth::Chest) + shape.factor(Girth::Underbust));
  return along({{0.0, chest}, {0.4, 0.5 * (1.0 + chest)}, {1.0, 0.6 + 0.4 * shape.factor(Girth::Neck)}}, t);
}

double leg_factor(const MannequinShape& shape, double s) {
  return along({{0.05, shape.factor(Girth::Thigh)},
                {0.26, shape.factor(Girth::MidThigh)},
                {0.40, shape.factor(Girth::Knee)},
                {0.56, shape.factor(Girth::Calf)},
                {0.87, shape.factor(Girth::Ankle)}},
               s);
}

}  // namespace toile
