// SPDX-License-Identifier: GPL-3.0-or-later
// How good a drape is, measured exactly against the meshes: what result.json reports and the guards judge.
#pragma once

#include "engine/core/body.h"
#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/geometry/closest_point.h"

namespace toile {

enum class Rest {
  Converged,  // residual force below 0.3 of a mean node's weight
  Settled,    // below 2.6 but for a fiftieth of the nodes, and no free edge moved by 0.5 mm over 50 iterations
  NotAtRest,
  AsGiven,  // taken as it was handed in: no residual, nothing moved
};
std::string_view rest_name(Rest rest);  // "converged", "settled", "not_at_rest", "as_given"

struct StrainPercentiles {
  double p50 = 0.0, p99 = 0.0;  // of the magnitude, area-weighted, dimensionless
};

struct DrapeQuality {
  Rest rest = Rest::NotAtRest;
  double residual = 0.0;       // rms nodal force over the mean node weight
  double settling_move = 0.0;  // largest mean-height change of a free edge over the last round, m
  StrainPercentiles weft, warp;
  StrainPercentiles shear;      // rad
  double deepest_node = 0.0;    // exact depth of nodes inside the body, m, 0 if none
  int nodes_inside = 0;         // deeper than 1 mm
  double deepest_edge = 0.0;    // of edge midpoints, m
  int edges_inside = 0;         // midpoints deeper than 3 mm
  int crossing_pairs = 0;       // pairs of triangles without a common node that cross
  double crossing_share = 0.0;  // share of triangles that cross another one
  double seam_gap = 0.0;        // largest distance between sewn vertices, m; 0 when seams are welded
};

// Everything but `rest`, `residual` and `settling_move`, which the solver knows. `surface` is that of the body.
DrapeQuality measure_drape(const PatternMesh& mesh, const SurfaceTree& surface, const Drape& drape);

// Depth of a point inside the surface, m, 0 outside.
double depth_inside(const SurfaceTree& surface, const Vec3& p);

// Pairs of triangles without a common node that cross, as numbers of `triangles`, ascending; at most `most`.
std::vector<std::pair<int, int>> crossing_pairs(const Points3& nodes, const Triangles& triangles, int most = 100000);

}  // namespace toile
