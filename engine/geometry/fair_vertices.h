// SPDX-License-Identifier: GPL-3.0-or-later
// Move some vertices of a surface to where it is smoothest.
#pragma once

#include <vector>

#include "engine/core/body.h"

namespace toile {

// The vertices `moving` minimise the thin-plate energy  sum_i A_i |(L x)_i|^2  over themselves and their neighbours;
// all others stay. L is the cotangent Laplacian of the current shape (weights clamped, so that thin triangles do no
// harm), A_i the vertex area; the first of two solves uses L of equal weights, which needs no good shape to start from.
// Where the moving part meets the rest, position and tangent go on. Requires moving vertices in rising order.
// Throws Error{Internal} if a part of the moving vertices touches nothing that stays.
void fair_vertices(TriangleMesh& mesh, const std::vector<int>& moving);

}  // namespace toile
