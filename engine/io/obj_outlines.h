// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts the outlines of texture islands into panel edges and finds which of them are sewn. Inner header of io.
//
// A border segment is one mesh edge on an outline. Two segments are mates when their ends meet in 3D. Outlines are cut
// where they turn by more than 30 degrees, where mates begin, end or jump, and wherever the mate's outline is cut; a
// side named by a sidecar is one edge.
#pragma once

#include "engine/core/pattern.h"
#include "engine/io/obj_islands.h"

namespace toile {

// All outlines one after another: segment i of an island runs from its outline vertex i to the next.
struct BorderSegments {
  std::vector<int> first;      // per island its first segment, and the total at the end
  std::vector<int> start;      // flat vertex that the segment starts at
  std::vector<int> island;     // of the segment
  std::vector<int> mate;       // or -1
  std::vector<bool> same_way;  // runs the same way as its mate: right_wrong
  std::vector<bool> cut;       // an edge begins at the start of the segment
  std::vector<bool> whole;     // no edge begins here, whatever the outline does: inside a side named by a sidecar

  int size() const { return static_cast<int>(start.size()); }
  int next(int i) const;
  int previous(int i) const;
};

struct OutlineEdges {
  std::vector<std::vector<std::vector<int>>> edge_vertices;  // per island and edge: flat vertices, both ends
  std::vector<Seam> seams;                                   // between mates; panels numbered as islands
  std::vector<SeamSide> side_of_segment;
};

BorderSegments border_segments(const ObjIslands& islands);

// Mates by position: ends within `tolerance` (file units of the positions) or of the same position number.
void find_mates(const ObjTextured& obj, const ObjIslands& islands, double tolerance, BorderSegments& borders);

// Marks that an edge begins at the start of the segment, and so on its mates' side.
void cut_at(BorderSegments& borders, int segment);

// Cuts the outlines and collects edges and seams.
OutlineEdges cut_outlines(const ObjIslands& islands, BorderSegments& borders);

}  // namespace toile
