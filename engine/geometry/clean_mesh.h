// SPDX-License-Identifier: GPL-3.0-or-later
// Make a triangle soup an oriented two-manifold, possibly with holes: the steps before holes are closed.
//
// A surface that is one already comes back unchanged, vertices and triangles in their order.
#pragma once

#include "engine/core/body.h"

namespace toile {

struct CleanMeshOptions {
  double speck_area = 0.02;     // pieces below this share of the largest piece's area go; 0..1  [registration.md, 1.1]
  double sliver_height = 1e-5;  // triangles flatter than this share of the mean edge length are mended; > 0
};

// What was done, as counts. Zeros: nothing was wrong.
struct CleanMeshReport {
  int repeated_corners = 0;     // triangles naming a vertex twice, removed
  int duplicate_triangles = 0;  // triangles on the same three vertices as another, removed
  int welded_vertices = 0;      // vertices of open edges merged with one of the same position
  int tangled_triangles = 0;    // triangles at edges of more than two triangles, removed
  int one_sided_triangles = 0;  // triangles at edges where no orientation agrees (Moebius bands), removed
  int pinched_triangles = 0;    // of small fans that hung by one point at the rim of a hole, removed
  int split_vertices = 0;       // vertices added where separate fans of triangles met in a point
  int specks = 0;               // small pieces removed
  int speck_triangles = 0;      // their triangles
  int slivers = 0;              // triangles without area, collapsed or flipped away
  int flipped_triangles = 0;    // turned to agree with the rest of their piece
  int unused_vertices = 0;      // vertices of no triangle, removed
};

// Requires indices in range. Ensures: no edge of more than two triangles, neighbours agree in orientation (outside or
// inside out as a whole: see orient_outward), one fan of triangles at every vertex. The result may be empty.
CleanMeshReport clean_mesh(TriangleMesh& mesh, const CleanMeshOptions& options = {});

// Turns every closed piece whose volume is negative; returns the number of turned triangles.
int orient_outward(TriangleMesh& mesh);

}  // namespace toile
