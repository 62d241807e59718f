// SPDX-License-Identifier: GPL-3.0-or-later
// Points of the left leg and arm of a mannequin's cage, in body heights. The trunk's points are there already: the
// limbs grow out of them.
#pragma once

#include "engine/bodies/mannequin_shape.h"

namespace toile {

void place_leg(const MannequinShape& shape, const MannequinCage& cage, Points3& points);
void place_arm(const MannequinShape& shape, const MannequinCage& cage, Points3& points);

// Right-handed frame of a straight piece of limb: along it, upwards across it, and to the front across it.
struct LimbFrame {
  Vec3 origin, along, up, front;

  // `turn` runs 0 below, 90 behind, 180 above, 270 in front, degrees.
  Vec3 at(double distance, double turn, double half_height, double half_depth) const;
  // The next piece, from `distance` on, bent to the front.
  LimbFrame bent(double distance, double degrees) const;
};

// A straight hand from the wrist at the frame's origin, the palm below. `length`, `breadth`: factors on an average
// hand.
void place_hand(const LimbFrame& wrist, double length, double breadth, const MannequinCage& cage, Points3& points);

}  // namespace toile
