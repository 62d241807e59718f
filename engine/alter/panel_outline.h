// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a meshed panel in counter-clockwise order.
#pragma once

#include <vector>

#include "engine/core/pattern_mesh.h"

namespace toile {

struct OutlineEdge {
  int edge = -1;              // of the panel
  std::vector<int> vertices;  // pattern vertices, counter-clockwise, both ends included
};

// Edges without length are left out.
std::vector<OutlineEdge> outline_edges(const PatternMesh& mesh, int panel);

// Turn from the end of one edge into the start of another, rad, > 0 to the left.
double turn_between(const Points2& rest, const OutlineEdge& before, const OutlineEdge& after);

}  // namespace toile
