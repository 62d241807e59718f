// SPDX-License-Identifier: GPL-3.0-or-later
// Where a garment belongs on a body: the lines its sleeves and trouser legs must enclose, and the levels it hangs from.
// Metres, normalised frame.
#pragma once

#include "engine/core/body.h"
#include "engine/geometry/closest_point.h"

namespace toile {

// Levels of the body a pattern's placement belongs to.
struct BodyLevels {
  double shoulder_y = 0.0;  // top of the shoulders on the skin
  double armpit_y = 0.0;
  double waist_y = 0.0;
  double crotch_y = 0.0;
};

struct BodyGuides {
  BodyLevels levels;
  double shoulder_z = 0.0;               // of the shoulder joints
  std::array<std::vector<Vec3>, 2> arm;  // by Side: middle of the arm from the shoulder joint to the finger tip
  std::array<std::vector<Vec3>, 2> leg;  // by Side: middle of the leg from the crotch's height down
  std::array<Vec3, 2> arm_direction;     // from shoulder to wrist in the xy plane, unit

  // Middle of the leg at a height, ends continued.
  Vec3 leg_at(Side side, double y) const;
  // Middle of the arm where it is `along` metres from the shoulder joint in the arm's direction, ends continued.
  Vec3 arm_at(Side side, double along) const;
};

// Requires a skeleton. `surface` is the tree of the body's surface.
BodyGuides find_body_guides(const Body& body, const SurfaceTree& surface);

// The body cut off at both upper arms, and closed there: what a garment without sleeves and bodice may touch.
// Hands of an A-pose hang at hip height and would catch a wide skirt.
TriangleMesh body_without_arms(const Body& body);

}  // namespace toile
