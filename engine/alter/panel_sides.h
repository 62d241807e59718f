// SPDX-License-Identifier: GPL-3.0-or-later
// The sides of a panel: runs of edges between corners, and who is sewn to whom along them.
#pragma once

#include <algorithm>

#include "engine/alter/dart_wedges.h"

namespace toile {

// Edges that turn less than this into each other are one side [method, Sec. 5].
inline constexpr double kCornerTurn = 30.0;  // degrees

struct PanelSide {
  std::vector<int> edges;     // of the panel, in counter-clockwise order
  std::vector<int> vertices;  // pattern vertices from corner to corner, counter-clockwise
  bool locked = false;        // holds a locked edge or a zip: neither opened nor cut
  bool sewn = false;          // at least one of its edges is

  bool holds(int vertex) const { return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end(); }
};

// Counter-clockwise round the panel; side i ends where side i + 1 begins. A panel without corners has one side.
// The legs of `wedges` belong to none: the side they interrupt runs on across the mouth.
std::vector<PanelSide> find_panel_sides(const Pattern& pattern, const PatternMesh& mesh, int panel,
                                        const std::vector<DartWedge>& wedges);

// Cloth turned in along a side: its hem or seam allowance, the least of its edges; none on a fold. m.
double allowance_of(const Pattern& pattern, int panel, const PanelSide& side);

// The most that every side is let out without new cloth, when `left` of what is turned in must remain; m.
std::vector<double> side_rooms(const Pattern& pattern, int panel, const std::vector<PanelSide>& sides, double left);

// The same sides on another mesh of the panel.
std::vector<PanelSide> same_sides(std::vector<PanelSide> sides, const PatternMesh& mesh, int panel);

// The same pattern vertex seen from the other ply.
struct SeamPartner {
  int panel = -1;
  int vertex = -1;
};
// Per pattern vertex: what it is sewn to (several where seams meet in a point).
std::vector<std::vector<SeamPartner>> find_seam_partners(const PatternMesh& mesh);

}  // namespace toile
