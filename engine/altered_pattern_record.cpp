// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/altered_pattern_record.h"

#include <cmath>

#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kCm2 = kCmPerMetre * kCmPerMetre;

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

// To a thousandth, so that documents stay small.
Record::Value points_mm(const std::vector<Vec2>& points) {
  std::vector<std::vector<double>> rows;
  for (const Vec2& p : points) rows.push_back({rounded(p.x() * kMmPerMetre, 1e-3), rounded(p.y() * kMmPerMetre, 1e-3)});
  return rows;
}

Record piece_record(const AlterPatternResult& altered, std::size_t i) {
  const SewnPiece& piece = altered.sewn.pieces[i];
  const PanelAlteration& panel = altered.panels[static_cast<std::size_t>(piece.panel)];
  Record record;
  record.add("panel", altered.sewn.pattern.panels[i].name)
      .add("of_panel", panel.panel)
      .add("cloth", piece.insertion >= 0 ? "new"
                    : piece.own_cloth    ? "cut_anew_out_of_own"
                    : piece.recut        ? "cut_anew"
                                         : "kept");
  if (piece.insertion >= 0)
    record.add("operation", panel.insertions[static_cast<std::size_t>(piece.insertion)].operation + 1);
  else
    record.add("stretch_p98", rounded(piece.strain, 1e-5));
  return record;
}

}  // namespace

Record altered_pattern_record(const AlterPatternResult& altered) {
  std::vector<Record> pieces, seams, removals;
  for (std::size_t i = 0; i < altered.sewn.pieces.size(); ++i) pieces.push_back(piece_record(altered, i));
  for (std::size_t s = 0; s < altered.sewn.seams.size(); ++s) {
    const SewnSeam& seam = altered.sewn.seams[s];
    seams.push_back(Record()
                        .add("stitch", static_cast<int>(s))
                        .add("added", seam.added)
                        .add("length_a_mm", rounded(seam.length_a * kMmPerMetre, 1e-3))
                        .add("length_b_mm", rounded(seam.length_b * kMmPerMetre, 1e-3)));
  }
  for (const PanelAlteration& panel : altered.panels)
    for (const AlteredRegion& region : panel.removals)
      removals.push_back(Record()
                             .add("name", region.name)
                             .add("panel", panel.panel)
                             .add("operation", region.operation + 1)
                             .add("area_cm2", rounded(region.area * kCm2, 1e-3))
                             .add("outline_mm", points_mm(region.shape.outline)));
  Record record;
  record.add("pieces", std::move(pieces))
      .add("seams", std::move(seams))
      .add("removals", std::move(removals))
      .add("flags", Record::Value(altered.sewn.flags));
  return record;
}

}  // namespace toile
