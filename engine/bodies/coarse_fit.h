// SPDX-License-Identifier: GPL-3.0-or-later
// Take a reference body into the pose and proportions of a target body, in closed form.
//
// x = sum_b W_b (A_b (v - a_b) + a'_b), between two such skinnings:
//   full  every bone from its segment to the target's, with its own girths: good across sex and shape
//   soft  trunk and head by one similarity, limbs by few segments: good within one family
// Source: shared design page "registration", section 1.4. Metres.
#pragma once

#include "engine/bodies/leg_profile.h"
#include "engine/core/body.h"

namespace toile {

// What the fit reads off a body beside its skeleton.
struct BodyProportions {
  Skeleton skeleton;
  std::array<double, 3> trunk_width{}, trunk_depth{};  // m, of the trunk's slice at pelvis, waist, chest
  std::array<Vec2, 9> trunk_low, trunk_high;  // m, its box (x, z) at even levels from pelvis to chest, smoothed
  double leg_girth = 0.0;                     // m, mean of both legs at 0.8 of the crotch height
  LegProfile legs;
};
BodyProportions find_proportions(const TriangleMesh& body, const Skeleton& skeleton);

// `weights` as bone_weights() gives them for the reference. Returns #V x 3.
Points3 coarse_fit(const Points3& reference_vertices, const Eigen::MatrixXd& weights, const BodyProportions& reference,
                   const BodyProportions& target);

}  // namespace toile
