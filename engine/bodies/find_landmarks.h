// SPDX-License-Identifier: GPL-3.0-or-later
// Named points on the skin of a normalised body, from its skeleton and levels. They are good to 1-4 cm: enough to
// orient, to show and to start from; landmarks carried by a registered body are better.
#pragma once

#include "engine/bodies/body_slices.h"
#include "engine/bodies/measure_body.h"

namespace toile {

// shoulder, elbow, wrist, bust, waist, hip, knee, ankle (each _l and _r), waist_front, waist_back, neck_front,
// neck_back, crotch, head_top. Requires levels.crotch and levels.armpit.
Landmarks find_landmarks(const TriangleMesh& body, const Skeleton& skeleton, const BodySlices& slices,
                         const MeasuringLevels& levels);

}  // namespace toile
