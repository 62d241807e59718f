// SPDX-License-Identifier: GPL-3.0-or-later
// Close the holes of a surface so smoothly that the patch goes on where the skin around it was heading.
//
// Each boundary loop is triangulated by dynamic programming (least worst fold, then least area), refined until its
// edges are as long as those around it, and faired: the new vertices minimise the thin-plate energy sum w |Lx|^2 over
// patch and loop, with everything outside held. Long loops are first cut in two at their narrowest place.
// Source: Liepa 2003, "Filling holes in meshes", sections 3-5.
#pragma once

#include <limits>

#include "engine/core/body.h"
#include "engine/core/progress.h"

namespace toile {

struct CloseHolesOptions {
  // New vertices stay at or above this height: soles that are missing in a scan become flat, not round. m or file unit.
  double lowest_y = -std::numeric_limits<double>::infinity();
};

struct ClosedHole {
  int edges = 0;               // of its boundary
  double perimeter = 0.0;      // in the mesh's unit
  Vec3 centre = Vec3::Zero();  // mean of its boundary vertices
  int added_vertices = 0;
  int added_triangles = 0;
};

// New vertices and triangles are appended; old ones keep their numbers and places.
// Requires: a manifold surface in agreeing orientation (clean_mesh). Ensures: closed, the same otherwise.
std::vector<ClosedHole> close_holes(TriangleMesh& mesh, const CloseHolesOptions& options = {},
                                    Progress* progress = nullptr);

}  // namespace toile
