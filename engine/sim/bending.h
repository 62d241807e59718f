// SPDX-License-Identifier: GPL-3.0-or-later
// Bending of cloth that is flat at rest, as a constant quadratic form: E = sum over coordinates of x^T Q x / 2.
//   at a node inside a panel   B/2 (k1^2 + k2^2): the integrated second derivatives uu, vv and uv at the node, each
//     squared over the node's Voronoi area (mixed finite elements, natural at free edges) [Stein2018]
//   at a node on a seam        B/2 (k1 + k2)^2, the same where cloth bends one way only: Q = B L^T M^-1 L, L the
//     cotangent Laplacian of the rest shapes that meet there
// The sum of curvatures alone lets a strip curl across its length for nothing and sag 5 % early. Stiffness does not
// depend on the mesh (a hinge model is up to three times stiffer on some). Rows of free edges are left out: they carry
// no moment. Source: design/method.md, section 3. N/m per coordinate.
#pragma once

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {

// #N x #N, both triangles stored. Cloth does not bend across `right_wrong` seams (one piece is turned over there) and
// across edges where more than two triangles meet.
SparseMatrix bending_matrix(const Pattern& pattern, const PatternMesh& mesh);

// Diagonal matrix above `bending` (row sums of magnitudes): stands for it in factored matrices, which stay sparser.
Eigen::VectorXd bending_bound(const SparseMatrix& bending);

}  // namespace toile
