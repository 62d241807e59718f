// SPDX-License-Identifier: GPL-3.0-or-later
// Catmull-Clark surfaces over closed meshes of quads: refine them, and place their points on the limit surface.
//
// Everything is linear in the control points, so that it is handed out as sparse matrices: one product evaluates the
// surface, and two surfaces over the same quads share vertices and triangles exactly.
// Source: [CatmullClark1978]; limit positions after [Halstead1993, Sec. 3].
#pragma once

#include <Eigen/SparseCore>

#include "engine/core/types.h"

namespace toile {

// One row per quad, counter-clockwise seen from outside; corners are row numbers of the control points.
using Quads = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 4, Eigen::RowMajor>;
using PointStencils = Eigen::SparseMatrix<double, Eigen::RowMajor>;  // #points x #control points, rows sum to 1

struct RefinedQuads {
  PointStencils points;  // control points of the finer mesh; the first rows belong to the coarse points, in order
  Quads quads;           // four to a coarse quad
};

// Requires: closed, every edge with exactly two quads of opposite direction; every point used.
RefinedQuads refine_catmull_clark(const Quads& quads, int point_count);

// Where every control point comes to lie on the limit surface. Requires: as above.
PointStencils catmull_clark_limit(const Quads& quads, int point_count);

// Control points whose limit surface passes near `wanted`, one per control point: `sweeps` Richardson steps, which
// reach the smooth part of the wish first and leave its zigzag for last.
Points3 interpolating_control_points(const PointStencils& limit, const Points3& wanted, int sweeps);

}  // namespace toile
