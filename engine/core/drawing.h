// SPDX-License-Identifier: GPL-3.0-or-later
// A pattern as it is drawn: pieces with typed lines, ready for every drawing format (SVG, PDF, DXF, PNG).
//
// Unit: millimetres (the one place inside the engine that is not in metres: a drawing is an edge of it). y up, x =
// weft. Every piece has its own frame, that of its panel; exporters lay pieces out (engine/io/layout.h). Curves are
// polylines within 0.02 mm of the curve; `turns` tells which of their points are corners.
#pragma once

#include <string_view>

#include "engine/core/pattern.h"
#include "engine/core/types.h"

namespace toile {

enum class LineKind {
  Cut,        // outer line: stitch line plus seam allowance
  Stitch,     // seam line; the panel's outline
  Fold,       // on which the cloth is cut folded, or a hem is turned
  Internal,   // drawn on the cloth: dart legs, keep-out regions, where an insertion was let in
  Grainline,  // warp direction, two points
  Insertion,  // outline of cloth added, drawn in its place on the panel (blue)
  Removal,    // outline of cloth taken away, drawn in its place on the panel (red)
  Original,   // the outline before, under a changed one
};
inline constexpr int kLineKindCount = 8;

struct DrawingLine {
  LineKind kind = LineKind::Stitch;
  std::vector<Vec2> points;
  bool closed = false;      // the last point joins the first, which is not repeated
  std::vector<bool> turns;  // one per point: a corner, where a cutter turns; empty: every point is one

  bool is_turn(std::size_t i) const { return turns.empty() || turns[i]; }
};

// A short mark across a seam, from the cut line inwards; seams meet notch to notch.
struct DrawingNotch {
  NotchType type = NotchType::V;
  Vec2 at = Vec2::Zero();      // on the cut line
  Vec2 inward = Vec2::Zero();  // unit, into the piece
  double depth = 5.0, width = 4.0;
  Vec2 on_stitch = Vec2::Zero();  // the same place on the stitch line
};

struct DrawingText {
  Vec2 at = Vec2::Zero();  // middle of the baseline
  double height = 8.0;     // of capitals
  std::string text;        // UTF-8
  double angle = 0.0;      // of the baseline, rad, counter-clockwise
};

enum class PieceRole {
  Panel,      // a piece of the pattern, or what is kept of it
  Insertion,  // cloth to cut anew and sew in
  Guide,      // shows how pieces go together; nothing to cut, so not for cutting machines
};

struct DrawingPiece {
  std::string name;   // unique in the drawing, the panel's or the insertion's
  std::string label;  // printed big, e.g. "front left"
  PieceRole role = PieceRole::Panel;
  int quantity = 1;
  std::string material;  // may be empty
  std::vector<DrawingLine> lines;
  std::vector<DrawingNotch> notches;
  std::vector<DrawingText> texts;  // guide sewing: "sew to front right, edge 3"
};

struct Drawing {
  std::string title;
  std::vector<DrawingPiece> pieces;
};

// "cut", "stitch", ...: the class names of the SVG.
std::string_view line_kind_name(LineKind kind);

// Lower and upper corner of everything drawn on a piece; two zero points for an empty one.
std::array<Vec2, 2> bounds(const DrawingPiece& piece);

}  // namespace toile
