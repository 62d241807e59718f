// SPDX-License-Identifier: GPL-3.0-or-later
// The measurements of measure_body that take part in fitting a mannequin, taken quickly: levels that are known are not
// sought, largest and least girths are sought in coarse steps first. Metres.
#pragma once

#include "engine/core/body.h"

namespace toile {

// `left_arm` are the triangles of that arm: on a stout body the plane across it would meet the trunk as well.
// `bust_y`: level of the bust points. Gives no shoulder_width and no arm_length.
// Ensures: skeleton.neck_y is the level of the least girth.
Measurements measure_mannequin(const TriangleMesh& surface, const Triangles& left_arm, Skeleton& skeleton,
                               double bust_y);

// Girth of the trunk at a share of the way from crotch to armpit.
double trunk_girth(const TriangleMesh& surface, const Skeleton& skeleton, double t);

}  // namespace toile
