// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/alter_pattern.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "engine/alter/read_operations.h"

namespace toile {
namespace {

TearPatternOptions pass_options(const AlterPatternOptions& options) {
  TearPatternOptions pass;
  pass.candidates.stretch_limit = options.stretch_limit;
  pass.candidates.least_strip = options.least_strip;
  pass.candidates.weighting = options.choice == TearChoice::Boundary ? TearWeighting::Boundary : TearWeighting::Release;
  pass.candidates.tear.mesh_edges = options.mesh_edge_cuts;
  pass.candidates.tear.smoothness = options.cut_smoothness;
  pass.choice.seam_preference = options.seam_preference;
  pass.choice.max_tears_per_side = options.max_tears_per_side;
  pass.choice.l_shapes = options.l_shapes;
  pass.choice.greedy = options.choice == TearChoice::Greedy;
  return pass;
}

std::vector<AlteredRegion> regions_of(const RecutPanel& recut, const std::string& prefix) {
  std::vector<AlteredRegion> regions;
  for (const PolygonWithHoles& opening : recut.openings)
    regions.push_back({prefix + std::to_string(regions.size() + 1), opening, area(opening), -1});
  return regions;
}

// Border edges of slits: cuts that end inside the cloth, whose lips lie on each other in the flat cloth.
bool on_slit(const Sheet& sheet, const BorderEdge& edge) {
  if (edge.side >= 0) return false;
  const auto holds = [](const Cut& cut, int v) {
    return std::any_of(cut.lips.begin(), cut.lips.end(),
                       [v](const auto& lips) { return lips.first == v || lips.second == v; });
  };
  return std::any_of(sheet.cuts.begin(), sheet.cuts.end(), [&](const Cut& cut) {
    return cut.lips.back().first == cut.lips.back().second && holds(cut, edge.from) && holds(cut, edge.to);
  });
}

// The flat cloth as the cuts part it, less what is taken away.
std::vector<PolygonWithHoles> kept_cloth(const Sheet& sheet, const RecutPanel& removal) {
  Loops taken;
  for (const PolygonWithHoles& opening : removal.openings) taken.push_back(opening.outline);
  std::vector<PolygonWithHoles> kept;
  for (const auto& loop : border_loops(sheet)) {
    std::vector<Vec2> outline;
    for (const BorderEdge& edge : loop)
      if (!on_slit(sheet, edge)) outline.push_back(sheet.vertices[static_cast<std::size_t>(edge.from)].flat);
    if (taken.empty())
      kept.push_back({outline, {}});
    else
      for (PolygonWithHoles& piece : polygon_difference({outline}, taken)) kept.push_back(std::move(piece));
  }
  return kept;
}

std::vector<std::vector<Vec2>> cut_lines(const Sheet& sheet) {
  std::vector<std::vector<Vec2>> lines;
  for (const Cut& cut : sheet.cuts) {
    lines.emplace_back();
    for (const auto& lips : cut.lips) lines.back().push_back(sheet.vertices[static_cast<std::size_t>(lips.first)].flat);
  }
  return lines;
}

void add_flag(AlterPatternResult& result, const std::string& panel, const char* pass, const PanelTearing& tearing) {
  if (tearing.done) return;
  char stretch[32];
  std::snprintf(stretch, sizeof stretch, "%.1f", 100.0 * tearing.after.p98);
  result.flags.push_back("panel " + panel + ": " + pass + " leaves " + stretch + " % stretch; " + tearing.reason);
}

void sum_up(AlterPatternResult& result) {
  for (const PanelAlteration& panel : result.panels) {
    result.original_area += signed_area(panel.original);
    result.target_area += signed_area(panel.target);
    for (const AlteredRegion& region : panel.insertions) result.inserted_area += region.area;
    for (const AlteredRegion& region : panel.removals) result.removed_area += region.area;
    add_flag(result, panel.panel, "inserting", panel.insertion_pass);
    add_flag(result, panel.panel, "removing", panel.removal_pass);
  }
  result.area_imbalance =
      std::abs(result.original_area + result.inserted_area - result.removed_area - result.target_area) /
      result.target_area;
}

}  // namespace

AlterPatternResult alter_pattern(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternOptions& options, Progress* progress) {
  assert(target_rest.rows() == mesh.vertex_count() && pattern.panels.size() == mesh.panels.size());
  const TearPatternOptions pass = pass_options(options);
  const TornPattern inserting = tear_pattern(pattern, mesh, mesh.rest, target_rest, pass, progress);
  const TornPattern removing = tear_pattern(pattern, mesh, target_rest, mesh.rest, pass, progress);
  AlterPatternResult result;
  result.insertion_rounds = inserting.rounds;
  result.removal_rounds = removing.rounds;
  result.trials = inserting.trials + removing.trials;
  result.reverted = inserting.reverted + removing.reverted;
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    const RecutPanel insertion = recut(inserting.sheets[p], {options.l_shapes});
    const RecutPanel removal = recut(removing.sheets[p], {options.l_shapes});
    PanelAlteration panel;
    panel.panel = pattern.panels[p].name;
    panel.original = removal.wanted;
    panel.target = insertion.wanted;
    panel.kept = kept_cloth(inserting.sheets[p], removal);
    panel.cut_lines = cut_lines(inserting.sheets[p]);
    panel.kept_in_target = insertion.kept;
    panel.insertions = regions_of(insertion, panel.panel + "_insertion_");
    panel.removals = regions_of(removal, panel.panel + "_removal_");
    panel.insertion_pass = inserting.panels[p];
    panel.removal_pass = removing.panels[p];
    result.dropped_regions += insertion.dropped + removal.dropped;
    result.panels.push_back(std::move(panel));
  }
  sum_up(result);
  read_operations(pattern, mesh, inserting, removing, options, result);
  return result;
}

}  // namespace toile
