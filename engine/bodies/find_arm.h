// SPDX-License-Identifier: GPL-3.0-or-later
// Find both arms of a normalised body by distances along its mesh edges.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Distance of each vertex from the finger tip of a side along mesh edges, with that side's arm.
struct ArmRings {
  int tip = -1;              // vertex of the finger tip
  Eigen::VectorXd distance;  // #V, m, from the tip; infinity where nothing leads
};

// The finger tips: on each side the vertex furthest along edges from the trunk under the armpits.
// Throws BodyNotRecognised if a side has none.
std::array<ArmRings, 2> find_arm_rings(const TriangleMesh& body, double height, double armpit_y);

// Centre line, length, girth and joints (metres). An arm ends where its ring of equal distance grows onto the trunk.
// A length of 0 says the end was not found. Source: shared design page "registration", section 1.2.
std::array<Skeleton::Arm, 2> find_arms(const TriangleMesh& body, double height, double armpit_y);

}  // namespace toile
