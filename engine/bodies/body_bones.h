// SPDX-License-Identifier: GPL-3.0-or-later
// Which bone moves which part of a body's skin.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Bones of limbs come in pairs: the value plus the Side.
enum Bone { Pelvis, Abdomen, Chest, Head, UpperArm = 4, Forearm = 6, Hand = 8, Thigh = 10, Shin = 12, Foot = 14 };
inline constexpr int kBoneCount = 16;

inline int bone_of(Bone limb, Side side) {
  return static_cast<int>(limb) + static_cast<int>(side);
}

// Skinning weights, #V x kBoneCount, each row >= 0 with sum 1: smooth steps over the distance along the arms and over
// the height, then one implicit smoothing along the mesh. No pose or training is needed. Requires the skeleton of this
// body. Source: shared design page "registration", section 1.3.
Eigen::MatrixXd bone_weights(const TriangleMesh& body, const Skeleton& skeleton);

}  // namespace toile
