// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/drawing_layout.h"

#include "engine/geometry/shelf_layout.h"

namespace toile {

SheetLayout lay_out(const Drawing& drawing, const SheetLayoutOptions& options) {
  std::vector<Vec2> sizes, lows;
  for (const DrawingPiece& piece : drawing.pieces) {
    const auto [low, high] = bounds(piece);
    sizes.emplace_back(high - low);
    lows.push_back(low);
  }
  const double width = options.width_mm > 0 ? options.width_mm : shelf_width(sizes, options.gap_mm, 1.5);
  const ShelfLayout shelves = lay_on_shelves(sizes, width, options.gap_mm);
  SheetLayout layout;
  const Vec2 margin = Vec2::Constant(options.margin_mm);
  for (std::size_t i = 0; i < sizes.size(); ++i) layout.shifts.emplace_back(shelves.corners[i] - lows[i] + margin);
  layout.size = shelves.size + 2 * margin + Vec2(0, options.header_mm);
  return layout;
}

}  // namespace toile
