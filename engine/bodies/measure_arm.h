// SPDX-License-Identifier: GPL-3.0-or-later
// Tape measurements across an arm, and the level of its wrist.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct ArmGirths {
  double upper_arm = 0.0;  // m, largest between elbow and armpit, across the upper arm
  double wrist = 0.0;      // m, least near the wrist, across the forearm
};

// Hull girths in planes square to the bone. 0 where the arm could not be sliced.
ArmGirths measure_arm(const TriangleMesh& body, const Skeleton::Arm& arm);

// The wrist on the axis of the forearm, from where the forearm has grown between its least and its largest girth: told
// by the side that hands, however spread or badly scanned, have no part in. The skeleton's where there is no such
// place.
Vec3 find_wrist(const TriangleMesh& body, const Skeleton::Arm& arm, double height);

}  // namespace toile
