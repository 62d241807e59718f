// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/alter_pattern.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "engine/alter/coarse_pattern.h"
#include "engine/alter/cut_anew.h"
#include "engine/alter/panel_twins.h"
#include "engine/alter/read_operations.h"
#include "engine/alter/search_tears.h"
#include "engine/alter/sew_altered.h"
#include "engine/core/side_by_side.h"
#include "engine/core/text.h"
#include "engine/core/units.h"

namespace toile {
namespace {

constexpr int kPlanTriangles = 600;   // of the garment: tears are chosen on so many
constexpr double kPastMouth = 0.001;  // m
constexpr double kStrained = 2.0;     // times the allowed stretch: share of a panel's area that strain in it explains
constexpr double kMostImbalance = 0.01;  // of the garment's area, that strain may add up to
constexpr double kMostMismatch = 5e-4;   // m, of two sides that are sewn to each other
constexpr double kStricter = 0.7;        // of the limit before: what a plan with a stricter one is made with
constexpr double kStrictest = 0.45;      // of the allowed stretch, at least
constexpr double kLeastOff = 5e-5;       // m^2: less is crumbs

TearPatternOptions pass_options(const Pattern& pattern, const AlterPatternOptions& options, bool removing) {
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
  pass.symmetric = options.symmetric && pattern.symmetry != Pattern::Symmetry::None;
  pass.removing = removing;
  return pass;
}

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

void add_flag(AlterPatternResult& result, const std::string& panel, const char* pass, const PanelTearing& tearing) {
  if (tearing.done) return;
  char stretch[32];
  std::snprintf(stretch, sizeof stretch, "%.1f", 100.0 * tearing.after.p95);
  result.flags.push_back("panel " + panel + ": " + pass + " leaves " + stretch + " % stretch; " + tearing.reason);
}

// More than strain explains is pieces that overlap, or an opening too small to sew in a panel that is small itself.
void check_balance(AlterPatternResult& result, const PanelAlteration& panel, double stretch_limit) {
  const double target = signed_area(panel.target);
  double off = signed_area(panel.original) - target - panel.cut_back;
  for (const AlteredRegion& region : panel.insertions) off += region.area;
  for (const AlteredRegion& region : panel.removals) off -= region.area;
  if (std::abs(off) <= kStrained * stretch_limit * target + kLeastOff) return;
  char share[32];
  std::snprintf(share, sizeof share, "%.1f", 100.0 * off / target);
  result.flags.push_back("panel " + panel.panel + ": pieces add up to " + share + " % more than its area");
}

// A panel that is cut anew has neither insertions nor removals. `targets`: with their darts filled.
void forget_tears(const Pattern& pattern, const std::vector<std::vector<Vec2>>& targets, RecutPanels& recut_panels,
                  AlterPatternResult& result) {
  for (auto& [p, anew] : recut_panels) {
    const auto index = static_cast<std::size_t>(p);
    PanelAlteration& panel = result.panels[index];
    panel.insertions.clear();
    panel.removals.clear();
    panel.kept.clear();
    panel.kept_in_target.clear();
    panel.cut_lines.clear();
    panel.cut_back = 0.0;
    anew.in_own_cloth =
        place_in_own_cloth(pattern.panels[index], pattern.seam_allowance, panel.original, targets[index]);
  }
}

// Where one of two mirror images is cut anew, so is the other: two sides sewn differently would show.
void add_twins(const Pattern& pattern, const std::vector<std::optional<PanelTwin>>& twins, RecutPanels& anew) {
  for (const auto& [p, how] : RecutPanels(anew))
    if (const auto& twin = twins[static_cast<std::size_t>(p)]; twin && twin->panel != p)
      if (!pattern.panels[static_cast<std::size_t>(twin->panel)].locked) {
        anew.try_emplace(twin->panel, CutAnew{"as its mirror image", {}, p});
        anew[p].mirror = twin->panel;
      }
}

void tell_cut_anew(const RecutPanels& anew, AlterPatternResult& result) {
  for (const auto& [p, panel] : anew) {
    const std::string& name = result.panels[static_cast<std::size_t>(p)].panel;
    if (!panel.in_own_cloth)
      result.flags.push_back("panel " + name + " is cut anew from new cloth: " + panel.why);
    else if (panel.in_own_cloth->turned)
      result.ticket.notes.push_back("Panel " + name +
                                    " fits into its own cloth only upside down: not where the cloth has a nap or a "
                                    "pattern with a direction.");
  }
}

void sum_up(const RecutPanels& anew, double stretch_limit, AlterPatternResult& result) {
  for (const auto& [p, how] : anew) {
    result.inserted_area += signed_area(result.panels[static_cast<std::size_t>(p)].target);
    result.removed_area += signed_area(result.panels[static_cast<std::size_t>(p)].original);
  }
  for (std::size_t p = 0; p < result.panels.size(); ++p) {
    const PanelAlteration& panel = result.panels[p];
    result.original_area += signed_area(panel.original);
    result.target_area += signed_area(panel.target);
    for (const AlteredRegion& region : panel.insertions) result.inserted_area += region.area;
    for (const AlteredRegion& region : panel.removals) result.removed_area += region.area;
    result.removed_area += panel.cut_back;
    if (anew.contains(static_cast<int>(p))) continue;
    add_flag(result, panel.panel, "inserting", panel.insertion_pass);
    add_flag(result, panel.panel, "removing", panel.removal_pass);
    if (panel.insertion_pass.done && panel.removal_pass.done) check_balance(result, panel, stretch_limit);
  }
  result.area_imbalance =
      std::abs(result.original_area + result.inserted_area - result.removed_area - result.target_area) /
      result.target_area;
}

PanelAlteration alteration_of(const Panel& panel, const TornPattern& inserting, const TornPattern& removing,
                              std::size_t p, const std::array<RecutPanel, 2>& recut,
                              const std::array<Loops, 2>& wedges) {
  const auto& [insertion, removal] = recut;
  const auto& [original_wedges, target_wedges] = wedges;
  PanelAlteration result;
  result.panel = panel.name;
  result.original = outline_without(removal.wanted, original_wedges);
  result.target = outline_without(insertion.wanted, target_wedges);
  result.kept = kept_cloth(inserting.sheets[p], removal, original_wedges);
  result.cut_lines = cut_lines(inserting.sheets[p]);
  for (const auto& kept : insertion.kept) result.kept_in_target.push_back(outline_without(kept, target_wedges));
  result.insertions = regions_of(insertion, panel.name + "_insertion_");
  result.removals = regions_of(removal, panel.name + "_removal_");
  result.insertion_pass = inserting.panels[p];
  result.removal_pass = removing.panels[p];
  result.cut_back = insertion.cut_back;
  return result;
}

void tell_cut_back(const AlterPatternOptions& options, AlterPatternResult& result) {
  if (std::any_of(result.panels.begin(), result.panels.end(),
                  [](const PanelAlteration& panel) { return panel.cut_back > 0.0; }))
    result.ticket.notes.push_back(print_text(
        "Strips are at least %.0f mm wide: where less is added, the cloth beside them is cut back by the difference.",
        options.least_strip * kMmPerMetre));
}

// What was planned with a stricter limit is judged by the one that is asked for.
void judge_by(double stretch_limit, TornPattern& torn) {
  for (PanelTearing& panel : torn.panels)
    if (!panel.overlaps && share_of_strain(panel.after, stretch_limit) < kNearEnough) {
      panel.done = true;
      panel.reason.clear();
    }
}

// The most strain any panel keeps over what is allowed; one that is cut anew keeps none.
double strain_left(const AlterPatternResult& result, const RecutPanels& anew, double stretch_limit) {
  double left = 0.0;
  for (std::size_t p = 0; p < result.panels.size(); ++p) {
    if (anew.contains(static_cast<int>(p))) continue;
    for (const PanelTearing* pass : {&result.panels[p].insertion_pass, &result.panels[p].removal_pass})
      left = std::max(left, share_of_limit(pass->after, stretch_limit));
  }
  return left;
}

// Both passes.
struct Torn {
  TornPattern inserting, removing;
};
struct TornMemory {
  TearMemory inserting, removing;
};

// Tears that are planned with `share` of the allowed stretch.
Torn tear_both(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, const CoarsePattern& coarse,
               const AlterPatternOptions& options, double share, TornMemory& memory, Progress* progress, bool at_once) {
  AlterPatternOptions planned = options;
  planned.stretch_limit *= share;
  auto [inserting, removing] = side_by_side(
      at_once,
      [&] {
        return tear_pattern(pattern, {mesh, mesh.rest, target_rest},
                            {coarse.mesh, coarse.mesh.rest, coarse.target_rest}, pass_options(pattern, planned, false),
                            memory.inserting, progress);
      },
      [&] {
        return tear_pattern(pattern, {mesh, target_rest, mesh.rest},
                            {coarse.mesh, coarse.target_rest, coarse.mesh.rest}, pass_options(pattern, planned, true),
                            memory.removing, progress);
      });
  judge_by(options.stretch_limit, inserting);
  judge_by(options.stretch_limit, removing);
  return {std::move(inserting), std::move(removing)};
}

// The same tears, jobs and cloth: what follows from them is the same.
bool torn_alike(const TornPattern& a, const TornPattern& b) {
  const auto same_tears = [](const PanelTearing& x, const PanelTearing& y) {
    return std::equal(x.tears.begin(), x.tears.end(), y.tears.begin(), y.tears.end(),
                      [](const MadeTear& s, const MadeTear& t) { return s.tear == t.tear; });
  };
  return a.jobs == b.jobs &&
         std::equal(a.sheets.begin(), a.sheets.end(), b.sheets.begin(), b.sheets.end(), lie_alike) &&
         std::equal(a.panels.begin(), a.panels.end(), b.panels.begin(), b.panels.end(), same_tears);
}

// The alteration that was planned with `share` of the allowed stretch and tears so.
AlterPatternResult altered(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                           const AlterPatternOptions& options, double share, const Torn& torn) {
  const auto& [inserting, removing] = torn;
  AlterPatternResult result;
  result.planned_share = share;
  result.insertion_rounds = inserting.rounds;
  result.removal_rounds = removing.rounds;
  result.trials = inserting.trials + removing.trials;
  result.reverted = inserting.reverted + removing.reverted;
  std::vector<std::vector<Vec2>> filled_targets;
  RecutPanels anew;
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    const Sheet& sheet = inserting.sheets[p];
    RecutOptions insert_options, remove_options;
    insert_options.l_shapes = remove_options.l_shapes = options.l_shapes;
    insert_options.least_strip = options.least_strip;
    insert_options.side_room = side_rooms(pattern, static_cast<int>(p), sheet.sides, options.least_allowance_left);
    const std::array<Loops, 2> wedges = {wedge_outlines(sheet.wedges, mesh.rest),
                                         wedge_outlines(sheet.wedges, target_rest)};
    insert_options.wedges = wedges[1];
    remove_options.wedges = wedges[0];
    const std::array<RecutPanel, 2> recuts = {recut(sheet, insert_options), recut(removing.sheets[p], remove_options)};
    filled_targets.push_back(recuts[0].wanted);
    result.dropped_regions += recuts[0].dropped + recuts[1].dropped;
    result.panels.push_back(alteration_of(pattern.panels[p], inserting, removing, p, recuts, wedges));
    const std::string why = hopeless(result.panels.back(), options.stretch_limit);
    if (!why.empty() && !pattern.panels[p].locked) anew[static_cast<int>(p)].why = why;
  }
  std::vector<std::optional<PanelTwin>> twins(pattern.panels.size());
  if (options.symmetric && pattern.symmetry != Pattern::Symmetry::None)
    twins = find_panel_twins(pattern, inserting.sheets);
  add_twins(pattern, twins, anew);
  for (std::size_t known = anew.size();; known = anew.size()) {  // what is cut anew changes what else there is to do
    forget_tears(pattern, filled_targets, anew, result);
    read_operations(pattern, mesh, inserting, removing, options, anew, result);
    result.sewn = sew_altered(pattern, mesh, target_rest, inserting, removing, result, anew);
    add_twins(pattern, twins, anew);
    if (anew.size() == known) break;
  }
  result.strain_left = strain_left(result, anew, options.stretch_limit);
  sum_up(anew, options.stretch_limit, result);
  tell_cut_anew(anew, result);
  tell_ticket(result.sewn, result.ticket);
  tell_cut_back(options, result);
  return result;
}

}  // namespace

std::size_t faults_of(const AlterPatternResult& result) {
  return result.flags.size() + result.sewn.flags.size() + (result.area_imbalance > kMostImbalance) +
         (seam_mismatch(result.sewn) > kMostMismatch);
}

AlterPatternResult alter_pattern(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternOptions& options, Progress* progress, bool at_once) {
  assert(target_rest.rows() == mesh.vertex_count() && pattern.panels.size() == mesh.panels.size());
  const CoarsePattern coarse = coarsen(pattern, mesh, target_rest, kPlanTriangles);
  TornMemory memory;
  const auto tear = [&](double share) {
    return tear_both(pattern, mesh, target_rest, coarse, options, share, memory, progress, at_once);
  };
  const auto with = [&](double share, const Torn& torn) {
    return altered(pattern, mesh, target_rest, options, share, torn);
  };
  std::vector<Torn> tried;
  tried.push_back(tear(options.planned_share));
  AlterPatternResult result = with(options.planned_share, tried.back());
  // Where something is wrong, less strain may mend it with as many operations.
  for (double share = kStricter * options.planned_share; share >= kStrictest && faults_of(result) > 0;
       share *= kStricter) {
    Torn torn = tear(share);
    const bool known = std::any_of(tried.begin(), tried.end(), [&](const Torn& other) {
      return torn_alike(other.inserting, torn.inserting) && torn_alike(other.removing, torn.removing);
    });
    if (known) continue;
    AlterPatternResult strict = with(share, torn);
    tried.push_back(std::move(torn));
    if (faults_of(strict) < faults_of(result) && strict.ticket.operations.size() <= result.ticket.operations.size())
      result = std::move(strict);
  }
  return result;
}

}  // namespace toile
