// SPDX-License-Identifier: GPL-3.0-or-later
// Find crotch, armpits, neck, trunk axis, legs and arms of a normalised body by slices and by ways along its surface.
//
// crotch   where the front-to-back thickness at the mid-plane ends, downward
// armpit   highest level at which an arm is a piece of its own
// legs     middle of the leg's slice near ankle, knee and hip
// arms     rings of equal distance from the finger tip along mesh edges, up to where they grow onto the trunk
// The same detector runs on reference and target: its biases cancel. It runs on holed, noisy, unrepaired scans.
// Source: shared design page "registration", section 1.2. Metres, normalised frame.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct FindSkeletonResult {
  Skeleton skeleton;
  double neck_girth = 0.0;            // m, least hull girth between shoulders and head
  std::vector<std::string> warnings;  // fallbacks taken and proportions beyond the usual
};

// Throws BodyNotRecognised if a part is missing or its proportions are no person's.
FindSkeletonResult find_skeleton(const TriangleMesh& body);

}  // namespace toile
