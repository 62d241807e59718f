// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/alter_pattern.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "engine/alter/coarse_pattern.h"
#include "engine/alter/cut_anew.h"
#include "engine/alter/cut_panel.h"
#include "engine/alter/panel_twins.h"
#include "engine/alter/read_operations.h"
#include "engine/alter/search_tears.h"
#include "engine/alter/sew_altered.h"
#include "engine/core/side_by_side.h"
#include "engine/core/text.h"
#include "engine/core/units.h"

namespace toile {

struct PlanMemory::Known {
  std::optional<CoarsePattern> coarse;
  TearMemory inserting, removing;
  CutMemory cut;
  SewMemory sewing;
};

namespace {

constexpr int kPlanTriangles = 600;  // of the garment: tears are chosen on so many
constexpr double kStrained = 2.0;    // times the allowed stretch: share of a panel's area that strain in it explains
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

// A panel that is cut anew has neither insertions nor removals.
void forget_tears(const Pattern& pattern, const std::vector<CutPanel*>& cuts, RecutPanels& recut_panels,
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
        place_in_own_cloth(pattern.panels[index], pattern.seam_allowance, panel.original, cuts[index]->filled_target);
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

// Tears that are planned with `share` of the allowed stretch.
Torn tear_both(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, const CoarsePattern& coarse,
               const AlterPatternOptions& options, double share, PlanMemory::Known& memory, Progress* progress,
               bool at_once) {
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
                           const AlterPatternOptions& options, double share, const Torn& torn,
                           PlanMemory::Known& memory) {
  const auto& [inserting, removing] = torn;
  AlterPatternResult result;
  result.planned_share = share;
  result.insertion_rounds = inserting.rounds;
  result.removal_rounds = removing.rounds;
  result.trials = inserting.trials + removing.trials;
  result.reverted = inserting.reverted + removing.reverted;
  std::vector<CutPanel*> cuts;
  memory.cut.resize(pattern.panels.size());
  RecutPanels anew;
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    CutPanel& cut =
        cut_panel(pattern, mesh, target_rest, p, inserting.sheets[p], removing.sheets[p], options, memory.cut[p]);
    cuts.push_back(&cut);
    result.dropped_regions += cut.dropped;
    result.panels.push_back(cut.alteration);
    result.panels.back().insertion_pass = inserting.panels[p];
    result.panels.back().removal_pass = removing.panels[p];
    const std::string why = hopeless(result.panels.back(), options.stretch_limit);
    if (!why.empty() && !pattern.panels[p].locked) anew[static_cast<int>(p)].why = why;
  }
  std::vector<std::optional<PanelTwin>> twins(pattern.panels.size());
  if (options.symmetric && pattern.symmetry != Pattern::Symmetry::None)
    twins = find_panel_twins(pattern, inserting.sheets);
  add_twins(pattern, twins, anew);
  for (std::size_t known = anew.size();; known = anew.size()) {  // what is cut anew changes what else there is to do
    forget_tears(pattern, cuts, anew, result);
    read_operations(pattern, mesh, inserting, removing, options, anew, result);
    result.sewn = sew_altered(pattern, mesh, target_rest, cuts, result, anew, memory.sewing);
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

PlanMemory::PlanMemory() : known_(std::make_unique<Known>()) {}
PlanMemory::~PlanMemory() = default;

AlterPatternResult alter_pattern(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternOptions& options, Progress* progress, bool at_once) {
  PlanMemory memory;
  return alter_pattern(pattern, mesh, target_rest, options, progress, at_once, memory);
}

AlterPatternResult alter_pattern(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternOptions& options, Progress* progress, bool at_once,
                                 PlanMemory& memory) {
  assert(target_rest.rows() == mesh.vertex_count() && pattern.panels.size() == mesh.panels.size());
  PlanMemory::Known& known = memory.known();
  if (!known.coarse) known.coarse = coarsen(pattern, mesh, target_rest, kPlanTriangles);
  const auto tear = [&](double share) {
    return tear_both(pattern, mesh, target_rest, *known.coarse, options, share, known, progress, at_once);
  };
  const auto with = [&](double share, const Torn& torn) {
    return altered(pattern, mesh, target_rest, options, share, torn, known);
  };
  std::vector<Torn> tried;
  tried.push_back(tear(options.planned_share));
  AlterPatternResult result = with(options.planned_share, tried.back());
  // Where something is wrong, less strain may mend it with as many operations.
  for (double share = kStricter * options.planned_share; share >= kStrictest && faults_of(result) > 0;
       share *= kStricter) {
    Torn torn = tear(share);
    const bool again = std::any_of(tried.begin(), tried.end(), [&](const Torn& other) {
      return torn_alike(other.inserting, torn.inserting) && torn_alike(other.removing, torn.removing);
    });
    if (again) continue;
    AlterPatternResult strict = with(share, torn);
    tried.push_back(std::move(torn));
    if (faults_of(strict) < faults_of(result) && strict.ticket.operations.size() <= result.ticket.operations.size())
      result = std::move(strict);
  }
  return result;
}

}  // namespace toile
