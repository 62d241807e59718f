// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a drape worked out again by other ways than the engine's: strains by barycentric gradients, depth by solid
// angles and brute force, crossings by signed volumes of all pairs.
#pragma once

#include <vector>

#include "engine/core/body.h"
#include "engine/core/pattern_mesh.h"

namespace toile::stress {

struct Strains {
  std::vector<double> weft, warp, area;  // per triangle: |Fu| - 1, |Fv| - 1, rest area in m^2
};
Strains strains(const PatternMesh& mesh, const Points2& rest, const Points3& nodes);

// The same as the fitting map shows them: at each middle the value of the plane through those of the triangles of the
// panel that share a corner, weighted by area, within their range; own ones where fewer than six share one.
Strains recovered(const PatternMesh& mesh, const Points2& rest, const Strains& own);

// Share of the area whose magnitude is at most `limit`.
double share_within(const std::vector<double>& values, const std::vector<double>& area, double limit);
// Area-weighted root mean square of both strains' differences.
double rms_difference(const Strains& a, const Strains& b);

// Depth of the deepest of the nodes inside the surface, m; `stride` > 1 looks at every so many.
double deepest_node(const Points3& nodes, const TriangleMesh& surface, int stride);

// Pairs of triangles without a common node of which an edge of one passes through the other. In a drape that is the
// same on both sides edges meet exactly, and whether such a pair crosses is a matter of rounding.
struct CrossingPairs {
  int sure = 0, possible = 0;  // without and with those that touch
};
CrossingPairs crossing_pairs_by_volumes(const PatternMesh& mesh, const Points3& nodes);

// Triangles of the flat mesh that lie turned over or without area.
int flipped_triangles(const Triangles& triangles, const Points2& rest);

double polygon_area(const std::vector<Vec2>& outline);  // > 0 counter-clockwise

}  // namespace toile::stress
