// SPDX-License-Identifier: GPL-3.0-or-later
// Stretch recovered from that of the triangles round about. That of one triangle is off by as much as stretch changes
// over it, to either side from neighbour to neighbour; the plane through those of a patch is not.
// Source: [ZienkiewiczZhu1992].
#pragma once

#include "engine/core/fitting_map.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

// Replaces weft and warp stretch and shear of every triangle by the value at its middle of the plane that fits those of
// the triangles of its panel sharing a corner with it best, weighted by area, within their range. Triangles with fewer
// than five of them keep their own. `rest` is #V x 2, m; tensors stay as they are.
void recover_stretch(const PatternMesh& mesh, const Points2& rest, FittingMap& map);

}  // namespace toile
