// SPDX-License-Identifier: GPL-3.0-or-later
// Notches of a panel's outline that hold folded cloth: darts, and slits whose legs lie side by side. The side they
// interrupt is one side, and the cloth inside their wedge is there, only folded away.
#pragma once

#include <array>
#include <vector>

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

struct DartWedge {
  std::array<int, 2> edges = {-1, -1};   // of the panel, in counter-clockwise order
  std::array<std::vector<int>, 2> legs;  // pattern vertices from the mouth to the apex; the apex ends both
  bool sewn = false;                     // its legs are sewn to each other; else a slit
};

// In counter-clockwise order round the panel. A wedge: two neighbouring edges that meet in a point inside, of about
// equal length and longer than their mouth, sewn to each other or not at all, in a side that goes on straight.
std::vector<DartWedge> find_dart_wedges(const Pattern& pattern, const PatternMesh& mesh, int panel);

// The same wedges on another mesh of the panel.
std::vector<DartWedge> same_wedges(std::vector<DartWedge> wedges, const PatternMesh& mesh, int panel);

// Triangles that fill the wedge between its legs, counter-clockwise, as pattern vertices.
std::vector<std::array<int, 3>> wedge_triangles(const DartWedge& wedge, const Points2& rest);

}  // namespace toile
