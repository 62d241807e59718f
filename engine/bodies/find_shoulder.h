// SPDX-License-Identifier: GPL-3.0-or-later
// The shoulder point of a normalised body, from the outline of its shoulders seen from the front.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Where the crest of the shoulder turns down into the arm. Between two stations beside neck and upper arm, the outline
// bulges over its chord; the middle of that bulge is the turn, and the shoulder point lies a fixed share of the height
// inside of it. An integral over 11 % of the height: noise, the density of the mesh and the pose of the arm hardly move
// it, and no armpit is needed, which scanners do not see. Metres; a point on the skin.
Vec3 find_shoulder_point(const TriangleMesh& body, const Skeleton& skeleton, Side side);

}  // namespace toile
