// SPDX-License-Identifier: GPL-3.0-or-later
// What garments made in code share: rectangular panels, and vertices sewn to nodes.
#pragma once

#include <string>

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile::test {

// Corners (0,0) (w,0) (w,h) (0,h) in metres: edges 0 bottom, 1 right, 2 top, 3 left, all straight.
Panel rectangle(const std::string& name, double width, double height);

// Fills node_of_vertex and node_count from seam_vertices: one node for all vertices that are sewn together.
void weld_seams(PatternMesh& mesh);

}  // namespace toile::test
