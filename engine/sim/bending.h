// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of cloth that is flat at rest, as a constant quadratic form: E = sum over coordinates of x^T Q x / 2 with
// Q = B sum over hinges 3 / (A0 + A1) k k^T, k the cotangent stencil of the hinge's two triangles.
// It approximates B/2 times the integral of the squared mean curvature (k1 + k2)^2, whatever the mesh; free edges carry
// no moment. Source: [Bergou2006, Wardetzky2007] (quadratic isometric bending). N/m per coordinate.
#pragma once

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {

// #N x #N, both triangles stored. Hinges across `right_wrong` seams, and edges where more than two triangles meet, are
// free.
SparseMatrix bending_matrix(const Pattern& pattern, const PatternMesh& mesh);

}  // namespace toile
