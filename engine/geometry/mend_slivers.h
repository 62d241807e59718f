// SPDX-License-Identifier: GPL-3.0-or-later
// Remove triangles without area from a manifold surface without opening it.
#pragma once

#include "engine/core/body.h"

namespace toile {

// A triangle is a sliver when its least height is below `height` times the mean edge length. Its shortest edge is
// collapsed if it is short, else its longest edge is flipped; what neither can mend without harm to the manifold stays.
// Vertices left without a triangle stay in the mesh. Returns how many slivers were mended.
//
// Requires: at most two triangles at an edge, in agreeing orientation. Ensures the same.
int mend_slivers(TriangleMesh& mesh, double height);

}  // namespace toile
