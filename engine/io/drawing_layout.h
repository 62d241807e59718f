// SPDX-License-Identifier: GPL-3.0-or-later
// Where each piece of a drawing stands on its sheet.
#pragma once

#include "engine/core/drawing.h"

namespace toile {

inline constexpr double kHeaderMm = 120.0;  // over the pieces, for title and test square

struct SheetLayout {
  std::vector<Vec2> shifts;  // added to a piece's own coordinates, mm, y up; one per piece
  Vec2 size = Vec2::Zero();  // of the sheet, mm
};

struct SheetLayoutOptions {
  double width_mm = 0.0;  // of the widest shelf; 0: so that the sheet is a little wider than tall
  double gap_mm = 20.0;   // between pieces
  double margin_mm = 15.0;
  double header_mm = 0.0;  // kept free along the top edge
};

// Pieces side by side without overlap, tallest first.
SheetLayout lay_out(const Drawing& drawing, const SheetLayoutOptions& options = {});

}  // namespace toile
