// SPDX-License-Identifier: GPL-3.0-or-later
// Tape measurements across an arm.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct ArmGirths {
  double upper_arm = 0.0;  // m, largest between elbow and armpit, across the upper arm
  double wrist = 0.0;      // m, least near the wrist, across the forearm
};

// Hull girths in planes square to the bone. 0 where the arm could not be sliced.
ArmGirths measure_arm(const TriangleMesh& body, const Skeleton::Arm& arm);

}  // namespace toile
