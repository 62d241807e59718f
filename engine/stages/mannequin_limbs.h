// SPDX-License-Identifier: GPL-3.0-or-later
// Points of the left leg and arm of a mannequin's cage, in body heights. The trunk's points are there already: the
// limbs grow out of them.
#pragma once

#include "engine/stages/mannequin_shape.h"

namespace toile {

void place_leg(const MannequinShape& shape, const MannequinCage& cage, Points3& points);
void place_arm(const MannequinShape& shape, const MannequinCage& cage, Points3& points);

}  // namespace toile
