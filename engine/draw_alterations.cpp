// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_alterations.h"

#include "engine/core/units.h"
#include "engine/stages/draw_pattern.h"

namespace toile {
namespace {

std::vector<Vec2> in_mm(const std::vector<Vec2>& points) {
  std::vector<Vec2> scaled;
  for (const Vec2& p : points) scaled.push_back(p * kMmPerMetre);
  return scaled;
}

DrawingLine line_of(LineKind kind, const std::vector<Vec2>& points, bool closed) {
  DrawingLine line;
  line.kind = kind;
  line.points = in_mm(points);
  line.closed = closed;
  return line;
}

void add_region(DrawingPiece& piece, LineKind kind, const PolygonWithHoles& region) {
  piece.lines.push_back(line_of(kind, region.outline, true));
  for (const auto& hole : region.holes) piece.lines.push_back(line_of(kind, hole, true));
}

DrawingPiece draw_insertion(const PanelAlteration& panel, const AlteredRegion& region) {
  DrawingPiece piece;
  piece.name = region.name;
  piece.label = "insert into " + panel.panel;
  piece.role = PieceRole::Insertion;
  add_region(piece, LineKind::Insertion, region.shape);
  const auto box = bounds(piece);
  const double x = 0.5 * (box[0].x() + box[1].x()), height = box[1].y() - box[0].y();
  DrawingLine grain;
  grain.kind = LineKind::Grainline;
  grain.points = {Vec2(x, box[0].y() + 0.25 * height), Vec2(x, box[1].y() - 0.25 * height)};
  piece.lines.push_back(std::move(grain));
  return piece;
}

}  // namespace

Drawing draw_alterations(const Pattern& pattern, const AlterPatternResult& altered) {
  Drawing drawing = draw_pattern(pattern);
  std::vector<DrawingPiece> insertions;
  for (std::size_t p = 0; p < altered.panels.size(); ++p) {
    const PanelAlteration& panel = altered.panels[p];
    DrawingPiece& piece = drawing.pieces[p];
    for (const AlteredRegion& region : panel.removals) add_region(piece, LineKind::Removal, region.shape);
    for (const auto& cut : panel.cut_lines) piece.lines.push_back(line_of(LineKind::Internal, cut, false));
    for (const AlteredRegion& region : panel.insertions) insertions.push_back(draw_insertion(panel, region));
  }
  drawing.pieces.insert(drawing.pieces.end(), insertions.begin(), insertions.end());
  return drawing;
}

}  // namespace toile
