// SPDX-License-Identifier: GPL-3.0-or-later
// One panel's cloth while it is stretched onto another outline and torn: a flat mesh, where its vertices are now, and
// which of them hang on which side of the wanted outline. Lengths in metres.
#pragma once

#include <array>
#include <optional>

#include "engine/alter/panel_sides.h"
#include "engine/alter/side_curve.h"
#include "engine/core/types.h"

namespace toile {

// What of the wanted outline a vertex of the cloth's outline belongs to; a corner belongs to two sides.
struct SheetAnchor {
  int side = -1;
  double at = 0.0;        // arc length along the cloth's own side
  bool attached = false;  // slides on the wanted side; else torn off it
  bool operator==(const SheetAnchor&) const = default;
};

struct SheetVertex {
  Vec2 flat = Vec2::Zero();   // in the cloth
  Vec2 guide = Vec2::Zero();  // where the plain map from the cloth to the wanted panel takes it
  Vec2 now = Vec2::Zero();    // where the stretched, torn cloth has it
  std::array<SheetAnchor, 2> anchors;
  int origin = -1;  // pattern vertex, or -1 where a cut made it

  bool on_side(int side) const { return anchors[0].side == side || anchors[1].side == side; }
  SheetAnchor* anchor(int side) {
    for (SheetAnchor& a : anchors)
      if (a.side == side) return &a;
    return nullptr;
  }
  const SheetAnchor* anchor(int side) const { return const_cast<SheetVertex*>(this)->anchor(side); }
};

// The two lips of a cut, from its mouth on: vertex pairs that were one vertex before. The cloth on the left of the way
// keeps `left`. Where the cut ends inside the cloth the last pair is one vertex.
struct Cut {
  std::vector<std::pair<int, int>> lips;  // left, right
};

struct Sheet {
  int panel = 0;
  std::vector<SheetVertex> vertices;
  std::vector<std::array<int, 3>> faces;  // counter-clockwise in `flat`
  std::vector<bool> folded;               // per face: inside a dart or slit, where the wanted panel sets the width
  std::vector<DartWedge> wedges;          // that the folded faces fill; pattern vertices
  std::vector<PanelSide> sides;           // of the panel
  std::vector<SideCurve> cloth_sides;     // in `flat`
  std::vector<SideCurve> wanted_sides;    // in `now`
  std::vector<Cut> cuts;                  // in the order they were made
  double edge_length = 0.0;               // mean, m
  // Across the axis about which the panel is its own mirror image: cloth that can slide stays in its middle. Unit.
  std::optional<Vec2> across;

  int vertex_count() const { return static_cast<int>(vertices.size()); }
};

// The cloth of `panel` with flat positions `cloth`, on its way to `wanted` (both #V x 2 of the pattern mesh), laid out
// by the plain map and attached all round. `like`: the panel's sheet on another mesh, whose sides this one shall have.
Sheet make_sheet(const Pattern& pattern, const PatternMesh& mesh, const Points2& cloth, const Points2& wanted,
                 int panel, const Sheet* like = nullptr);

Vec2 extent_of(const Sheet& sheet);  // of the cloth, weft and warp, m

// Directed border edges (cloth on the left), each with the side it lies on, or -1 for the lip of a cut.
struct BorderEdge {
  int from = 0, to = 0, side = -1;
};
std::vector<BorderEdge> border_edges(const Sheet& sheet);
// The same as closed loops, each in walking order.
std::vector<std::vector<BorderEdge>> border_loops(const Sheet& sheet);

}  // namespace toile
