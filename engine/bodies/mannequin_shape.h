// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of a mannequin: where the points of its cage lie, from a handful of lengths and factors.
//
// Every row of the trunk, the neck, the head and the legs is a fan of rays from a point on the body's axis; a table
// gives the distance to the skin along each ray as a share of body height, linear in sex and fatness. Lengths in
// metres.
#pragma once

#include <array>

#include "engine/bodies/mannequin_cage.h"

namespace toile {

// Where the radii of the tables can be scaled; between them the factors run linearly along the body.
enum class Girth {
  Head,
  Neck,
  Chest,
  Bust,
  Underbust,
  Waist,
  Belly,
  Hip,
  Thigh,
  MidThigh,
  Knee,
  Calf,
  Ankle,
  UpperArm,
  Elbow,
  Wrist,
  Count
};

struct MannequinShape {
  double height = 1.68;
  double crotch_height = 0.77;
  double sex = 0.0;             // -1 woman ... 1 man; children and the average of both 0
  double fatness = 0.0;         // (waist girth / height - 0.47) / 0.06, clamped to what the table was fitted for
  double head_girth = 1.0;      // a child's skull against an adult's of the same height, 1 for adults
  double head_height = 1.0;     // the same from chin to crown
  double shoulder_width = 1.0;  // factor on the breadth of shoulders and upper back
  double arm_length = 1.0;      // factors on the average share of height
  double foot_length = 1.0;
  std::array<double, static_cast<std::size_t>(Girth::Count)> factors = filled_with_one();

  double& factor(Girth girth) { return factors[static_cast<std::size_t>(girth)]; }
  double factor(Girth girth) const { return factors[static_cast<std::size_t>(girth)]; }

 private:
  static constexpr std::array<double, static_cast<std::size_t>(Girth::Count)> filled_with_one() {
    std::array<double, static_cast<std::size_t>(Girth::Count)> ones{};
    for (double& one : ones) one = 1.0;
    return ones;
  }
};

// Where the surface shall pass, one row per point of the left half of the cage.
Points3 mannequin_cage_points(const MannequinShape& shape, const MannequinCage& cage);

// The vertices of the template in this shape: symmetric about x = 0, soles on y = 0, the crown at `height`.
Points3 mannequin_surface(const MannequinShape& shape);

}  // namespace toile
