// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/alter_pairs.h"

#include <algorithm>
#include <map>

#include "engine/core/drawing.h"
#include "engine/core/units.h"
#include "engine/geometry/inner_point.h"
#include "engine/render/drawing_picture.h"
#include "engine/stage_options.h"

namespace toile::bench {
namespace {

constexpr int kGap = 24;  // pixels between tiled pictures

std::vector<Vec2> in_mm(std::vector<Vec2> line, const Vec2& shift = Vec2::Zero()) {
  for (Vec2& p : line) p = p * kMmPerMetre + shift;
  return line;
}

DrawingPiece panel_piece(const PanelAlteration& panel) {
  DrawingPiece piece;
  piece.name = panel.panel;
  double right = -1e9, left = 1e9, top = -1e9;
  for (const Vec2& p : panel.original) right = std::max(right, p.x()), top = std::max(top, p.y());
  for (const Vec2& p : panel.target) left = std::min(left, p.x()), top = std::max(top, p.y());
  const Vec2 shift((right - left) * kMmPerMetre + 40, 0);
  piece.lines.push_back({LineKind::Original, in_mm(panel.original), true, {}});
  for (const auto& region : panel.removals)
    piece.lines.push_back({LineKind::Removal, in_mm(region.shape.outline), true, {}});
  for (const auto& cut : panel.cut_lines) piece.lines.push_back({LineKind::Insertion, in_mm(cut), false, {}});
  for (const auto& part : panel.kept) piece.lines.push_back({LineKind::Stitch, in_mm(part.outline), true, {}});
  piece.lines.push_back({LineKind::Original, in_mm(panel.target, shift), true, {}});
  for (const auto& part : panel.kept_in_target) piece.lines.push_back({LineKind::Stitch, in_mm(part, shift), true, {}});
  for (const auto& region : panel.insertions)
    piece.lines.push_back({LineKind::Insertion, in_mm(region.shape.outline, shift), true, {}});
  piece.texts.push_back({Vec2(right * kMmPerMetre, top * kMmPerMetre + 12), 14.0, panel.panel});
  return piece;
}

// Widest place of the narrowest piece of cloth that is let in.
double narrowest_insertion(const AlterPatternResult& result) {
  double narrowest = 1e9;
  for (const PanelAlteration& panel : result.panels)
    for (const AlteredRegion& region : panel.insertions) {
      if (region.operation < 0) continue;
      if (result.ticket.operations[static_cast<std::size_t>(region.operation)].fabric != FabricNeed::NeedsFabric)
        continue;
      narrowest = std::min(narrowest, 2.0 * roomiest_point(region.shape.outline).clearance);
    }
  return narrowest < 1e9 ? narrowest : 0.0;
}

}  // namespace

std::vector<AlterPair> acceptance_pairs() {
  std::vector<AlterPair> pairs;
  for (const char* garment : {"leggings_tight", "leggings_zero_ease", "tshirt_fitted", "pants_straight", "skirt_pencil",
                              "dress_sleeveless", "shirt_darts_long", "sweater_loose_hood"})
    for (const char* body : {"ggg_small_female", "ggg_mean_female", "ggg_male_extra", "ggg_large_male", "scan_b"})
      pairs.push_back({garment, body});
  return pairs;
}

AlterOutcome outcome_of(const AlterPatternResult& result) {
  AlterOutcome outcome;
  outcome.operations = result.ticket.operations.size();
  outcome.flags = result.flags.size() + result.sewn.flags.size();
  for (const PanelAlteration& panel : result.panels) {
    std::map<int, int> cuts;
    for (const PanelTearing* pass : {&panel.insertion_pass, &panel.removal_pass}) {
      outcome.strain_before = std::max(outcome.strain_before, pass->before.p95);
      outcome.strain_after = std::max(outcome.strain_after, pass->after.p95);
      outcome.tears += pass->tears.size();
      for (const MadeTear& made : pass->tears)
        if (made.tear.kind == TearKind::Edge) outcome.most_cuts = std::max(outcome.most_cuts, ++cuts[made.tear.side]);
    }
  }
  outcome.narrowest = narrowest_insertion(result);
  outcome.balance = result.area_imbalance;
  outcome.plies = seam_mismatch(result.sewn);
  return outcome;
}

AlterFit fit_of(const DerivedGarment& derived, const AlterPatternResult& result, const AlterOptions& options) {
  const PatternMesh& mesh = derived.reference.mesh;
  AlterFit fit;
  fit.stretch_before = compare_fits(mesh, derived.reference.fit, derived.fit_before).whole.rms_stretch;
  fit.stretch_ideal = compare_fits(mesh, derived.reference.fit, derived.derived.fit).whole.rms_stretch;
  fit.position_ideal = compare_positions(derived.transported.drape.nodes, derived.derived.drape.drape.nodes).rms;
  DrapeSeries on_target(derived.target_body);
  const auto drape_at = [&](const SewnPattern& sewn, const Drape& start) {
    return drape_altered(scene_of(derived, start), sewn, {}, on_target, drape_options_of(options));
  };
  const DrapedAlteration after = drape_at(result.sewn, derived.derived.drape.drape);
  fit.problem = after.problem;
  if (!fit.problem.empty()) return fit;
  fit.stretch_after = compare_fits(after.mesh, after.reference, after.fit).whole.rms_stretch;
  fit.position_after = drape_at(result.sewn, derived.transported.drape).position.rms;
  fit.position_anew = position_meshed_anew(scene_of(derived, derived.transported.drape), derived.derived.drawn.pattern,
                                           mesh.target_edge_length, on_target, drape_options_of(options))
                          .value_or(0.0);
  return fit;
}

AlterationScene scene_of(const DerivedGarment& derived, const Drape& start) {
  return {derived.reference.mesh, derived.reference.fit, derived.derived.mesh, start};
}

AlterInLoopResult alter_derived(const DerivedGarment& derived, const AlterOptions& job) {
  DrapeSeries on_target(derived.target_body);
  return alter_in_loop(derived.reference.pattern, scene_of(derived, derived.transported.drape), derived.derived,
                       on_target, alter_options_of(job), drape_options_of(job), plan_options_of(job));
}

Image picture_of(const std::string& title, const AlterPatternResult& result, int width) {
  Drawing drawing{title, {}};
  for (const PanelAlteration& panel : result.panels) drawing.pieces.push_back(panel_piece(panel));
  DrawingPictureOptions options;
  options.width = width;
  options.title = title + ": " + std::to_string(result.ticket.operations.size()) + " operations, " +
                  std::to_string(result.flags.size() + result.sewn.flags.size()) + " flags";
  return draw_picture(drawing, options);
}

Image tile(const std::vector<Image>& pictures, int columns) {
  std::vector<int> heights;
  int width = 0, height = kGap;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) == 0) heights.push_back(0);
    heights.back() = std::max(heights.back(), pictures[i].height);
    width = std::max(width, pictures[i].width);
  }
  for (const int row : heights) height += row + kGap;
  Image sheet(kGap + columns * (width + kGap), height, {255, 255, 255});
  int y = kGap;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto column = static_cast<int>(i) % columns;
    paste(sheet, pictures[i], kGap + column * (width + kGap), y);
    if (column + 1 == columns) y += heights[i / static_cast<std::size_t>(columns)] + kGap;
  }
  return sheet;
}

}  // namespace toile::bench
