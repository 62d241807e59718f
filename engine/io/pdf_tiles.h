// SPDX-License-Identifier: GPL-3.0-or-later
// How a large sheet is cut into pages that overlap. Millimetres, y up.
#pragma once

#include <string>

#include "engine/io/drawing_layout.h"

namespace toile {

struct Paper {
  Vec2 size = Vec2::Zero();  // mm
  double margin = 10.0;      // that printers leave blank
  double overlap = 10.0;     // printed beyond the frame on the right and below

  Vec2 frame() const { return size - Vec2::Constant(2 * margin + overlap); }  // of the sheet a page shows
};

struct Tile {
  int row = 0, column = 0;   // from the upper left
  Vec2 low = Vec2::Zero();   // lower left corner of its frame on the sheet
  std::string name() const;  // "A1": row A, column 1; after Z comes AA
};

struct Tiling {
  int rows = 0, columns = 0;
  std::vector<Tile> tiles;  // not blank, row by row
};

// Tiles of the sheet that a piece's box or line touches.
Tiling tile_sheet(const Drawing& drawing, const SheetLayout& layout, const Paper& paper);

}  // namespace toile
