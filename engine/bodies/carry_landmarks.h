// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a reference body where a body map takes them.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Each point is bound to the closest place of the reference's surface and moved with it. `mapped`: #V(reference) x 3.
Landmarks carry_landmarks(const Landmarks& points, const TriangleMesh& reference, const Points3& mapped);

}  // namespace toile
