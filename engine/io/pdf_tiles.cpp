// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/pdf_tiles.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

// Does the segment reach into the box? Exact but for rounding: by clipping (Liang and Barsky).
bool touches(const Vec2& a, const Vec2& b, const Vec2& low, const Vec2& high) {
  double from = 0.0, to = 1.0;
  for (int k = 0; k < 2; ++k) {
    const double d = b[k] - a[k];
    if (d == 0.0) {
      if (a[k] < low[k] || a[k] > high[k]) return false;
      continue;
    }
    const double enter = (low[k] - a[k]) / d, leave = (high[k] - a[k]) / d;
    from = std::max(from, std::min(enter, leave)), to = std::min(to, std::max(enter, leave));
  }
  return from <= to;
}

bool touches(const DrawingPiece& piece, const Vec2& low, const Vec2& high) {
  for (const DrawingLine& line : piece.lines) {
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i)
      if (touches(line.points[i], line.points[(i + 1) % count], low, high)) return true;
  }
  return std::any_of(piece.texts.begin(), piece.texts.end(), [&](const DrawingText& text) {
    const Vec2 half(0.4 * text.height * static_cast<double>(text.text.size()), text.height);
    return (text.at + half - low).minCoeff() >= 0 && (high - text.at + half).minCoeff() >= 0;
  });
}

}  // namespace

std::string Tile::name() const {
  std::string letters(1, static_cast<char>('A' + row % 26));
  for (int rest = row / 26; rest > 0; rest = (rest - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return letters + std::to_string(column + 1);
}

Tiling tile_sheet(const Drawing& drawing, const SheetLayout& layout, const Paper& paper) {
  const Vec2 frame = paper.frame();
  Tiling tiling;
  tiling.columns = std::max(1, static_cast<int>(std::ceil(layout.size.x() / frame.x() - 1e-9)));
  tiling.rows = std::max(1, static_cast<int>(std::ceil(layout.size.y() / frame.y() - 1e-9)));
  for (int row = 0; row < tiling.rows; ++row)
    for (int column = 0; column < tiling.columns; ++column) {
      const Vec2 low(column * frame.x(), layout.size.y() - (row + 1) * frame.y());
      for (std::size_t i = 0; i < drawing.pieces.size(); ++i)
        if (touches(drawing.pieces[i], low - layout.shifts[i], low + frame - layout.shifts[i])) {
          tiling.tiles.push_back({row, column, low});
          break;
        }
    }
  return tiling;
}

}  // namespace toile
