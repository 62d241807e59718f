// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/cut_panel.h"

#include <algorithm>

#include "engine/alter/panel_sides.h"
#include "engine/alter/recut.h"
#include "engine/alter/tear_memory.h"

namespace toile {
namespace {

constexpr double kPastMouth = 0.001;  // m
constexpr double kCrumb = 1e-4;       // m^2

// Outlines of a panel's darts and slits, which the stretched sheet has filled; a little past the mouth, so that no skin
// of cloth closes it.
Loops wedge_outlines(const std::vector<DartWedge>& wedges, const Points2& rest) {
  Loops outlines;
  for (const DartWedge& wedge : wedges) {
    std::vector<Vec2> loop;
    const auto add_past = [&](const std::vector<int>& leg) {
      const Vec2 mouth = rest.row(leg[0]), next = rest.row(leg[1]);
      loop.emplace_back(mouth + kPastMouth * (mouth - next).normalized());
    };
    add_past(wedge.legs[1]);
    for (const int v : wedge.legs[1]) loop.emplace_back(rest.row(v));
    for (auto v = wedge.legs[0].rbegin() + 1; v != wedge.legs[0].rend(); ++v) loop.emplace_back(rest.row(*v));
    add_past(wedge.legs[0]);
    outlines.push_back(std::move(loop));
  }
  return outlines;
}

// A cut along the tip of a dart parts the cloth there in two.
Loops parts_without(const std::vector<Vec2>& outline, const Loops& wedges) {
  if (wedges.empty()) return {outline};
  Loops parts;
  for (PolygonWithHoles& part : polygon_difference({outline}, wedges))
    if (area(part) > kCrumb) parts.push_back(std::move(part.outline));
  return parts;
}

// The largest part: crumbs come from darts of the target that cross themselves.
std::vector<Vec2> outline_without(const std::vector<Vec2>& outline, const Loops& wedges) {
  if (wedges.empty()) return outline;
  std::vector<Vec2> largest = outline;
  double most = 0.0;
  for (const PolygonWithHoles& part : polygon_difference({outline}, wedges))
    if (area(part) > most) {
      most = area(part);
      largest = part.outline;
    }
  return largest;
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
std::vector<PolygonWithHoles> kept_cloth(const Sheet& sheet, const RecutPanel& removal, const Loops& wedges) {
  Loops taken = wedges;
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

PanelAlteration alteration_of(const Panel& panel, const Sheet& inserting, const std::array<RecutPanel, 2>& recut,
                              const std::array<Loops, 2>& wedges) {
  const auto& [insertion, removal] = recut;
  const auto& [original_wedges, target_wedges] = wedges;
  PanelAlteration result;
  result.panel = panel.name;
  result.original = outline_without(removal.wanted, original_wedges);
  result.target = outline_without(insertion.wanted, target_wedges);
  result.kept = kept_cloth(inserting, removal, original_wedges);
  result.cut_lines = cut_lines(inserting);
  for (const auto& kept : insertion.kept)
    for (auto& part : parts_without(kept, target_wedges)) result.kept_in_target.push_back(std::move(part));
  result.insertions = regions_of(insertion, panel.name + "_insertion_");
  result.removals = regions_of(removal, panel.name + "_removal_");
  result.cut_back = insertion.cut_back;
  return result;
}

}  // namespace

CutPanel& cut_panel(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, std::size_t p,
                    const Sheet& inserting, const Sheet& removing, const AlterPatternOptions& options,
                    std::list<CutPanel>& known) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const CutPanel& cut) {
    return lie_alike(cut.inserting, inserting) && lie_alike(cut.removing, removing);
  });
  if (found != known.end()) return *found;
  RecutOptions insert_options, remove_options;
  insert_options.l_shapes = remove_options.l_shapes = options.l_shapes;
  insert_options.least_strip = options.least_strip;
  insert_options.side_room = side_rooms(pattern, static_cast<int>(p), inserting.sides, options.least_allowance_left);
  const std::array<Loops, 2> wedges = {wedge_outlines(inserting.wedges, mesh.rest),
                                       wedge_outlines(inserting.wedges, target_rest)};
  insert_options.wedges = wedges[1];
  remove_options.wedges = wedges[0];
  const std::array<RecutPanel, 2> recuts = {recut(inserting, insert_options), recut(removing, remove_options)};
  known.push_back({inserting,
                   removing,
                   alteration_of(pattern.panels[p], inserting, recuts, wedges),
                   recuts[0].wanted,
                   recuts[0].dropped + recuts[1].dropped,
                   {}});
  return known.back();
}

}  // namespace toile
