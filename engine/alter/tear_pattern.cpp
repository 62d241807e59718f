// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_pattern.h"

#include <algorithm>
#include <numeric>

#include "engine/alter/choose_sets.h"
#include "engine/alter/couple_plies.h"
#include "engine/alter/lay_sheet.h"
#include "engine/alter/search_tears.h"
#include "engine/alter/tear_in_rounds.h"
#include "engine/core/work_off.h"

namespace toile {
namespace {

std::vector<Sheet> make_sheets(const Pattern& pattern, const Stretching& maps,
                               const std::vector<Sheet>* like = nullptr) {
  std::vector<Sheet> sheets;
  for (int p = 0; p < static_cast<int>(pattern.panels.size()); ++p)
    sheets.push_back(make_sheet(pattern, maps.mesh, maps.cloth, maps.wanted, p,
                                like ? &(*like)[static_cast<std::size_t>(p)] : nullptr));
  return sheets;
}

// A panel that is its own mirror image, and is altered so, is cloth that stays in its middle.
void keep_in_the_middle(const std::vector<std::optional<PanelTwin>>& twins, std::vector<Sheet>& sheets) {
  for (std::size_t p = 0; p < sheets.size(); ++p) {
    if (!twins[p] || twins[p]->panel != static_cast<int>(p)) continue;
    // A reflection turns what lies across its axis around: eigenvalues come in rising order, -1 first.
    sheets[p].across = Eigen::SelfAdjointEigenSolver<Mat2>(twins[p]->reflection).eigenvectors().col(0);
  }
}

// Decides on a coarse mesh which tears every panel gets.
class Planning {
 public:
  Planning(const Pattern& pattern, const PatternMesh& mesh, std::vector<Sheet> sheets,
           std::vector<std::optional<PanelTwin>> twins, const TearPatternOptions& options, TearMemory& memory,
           Progress* progress)
      : pattern_(pattern),
        options_(options),
        memory_(memory),
        progress_(progress),
        partners_(find_seam_partners(mesh)),
        sheets_(std::move(sheets)),
        twins_(std::move(twins)) {
    plan_.panels.resize(sheets_.size());
    plan_.jobs.resize(sheets_.size());
    stretched_.assign(sheets_.size(), false);
    units_ = side_units(pattern, sheets_, partners_, twins_);
    sets_.resize(sheets_.size());
    trials_.assign(sheets_.size(), 0);
  }

  // Panels with their stress before and their tears; the sheets are the stretched, untorn ones.
  TornPattern run() {
    stretch();
    search_sides();
    search_cuts();
    if (std::any_of(sets_.begin(), sets_.end(), [](const auto& sets) { return sets.size() > 1; })) choose();
    plan_.trials = std::accumulate(trials_.begin(), trials_.end(), 0);
    plan_.sheets = std::move(sheets_);
    return std::move(plan_);
  }

 private:
  double limit() const { return options_.candidates.stretch_limit; }
  bool locked(std::size_t p) const { return pattern_.panels[p].locked; }
  bool chooses(std::size_t p) const { return units_.chooser[p] == static_cast<int>(p); }

  void stretch();
  void search_sides();
  void search_panel(std::size_t p, int first_unit);
  void search_cuts();
  void choose();
  void take_set(std::size_t p, const TearSet& set);
  double release_of(std::size_t p, std::vector<int> units, int last) const;

  const Pattern& pattern_;
  const TearPatternOptions& options_;
  TearMemory& memory_;
  Progress* progress_;
  std::vector<std::vector<SeamPartner>> partners_;
  std::vector<Sheet> sheets_;
  std::vector<char> stretched_;  // per panel; not of bits: panels are worked off at once
  std::vector<std::optional<PanelTwin>> twins_;
  TearUnits units_;
  std::vector<std::vector<TearSet>> sets_;  // per panel that chooses
  std::vector<int> trials_;                 // per panel
  TornPattern plan_;
};

void Planning::stretch() {
  work_off(sheets_.size(), [&](std::size_t p) {
    SheetStress& before = plan_.panels[p].before;
    before = measure_stress(sheets_[p]);
    // The plain map is the start; where it has no tension it stays, and there is nothing to relax.
    if (locked(p) || share_of_limit(before, limit()) < 1.0) return;
    PanelMemory& known = memory_[p];
    if (!known.stretched) {
      const RelaxOptions& relaxation = options_.candidates.tear.relaxation;
      relax(sheets_[p], relaxation, progress_, &equations_of(known.coarse, sheets_[p], relaxation.hold));
      known.stretched = std::make_shared<const Sheet>(sheets_[p]);
    }
    sheets_[p] = *known.stretched;
    stretched_[p] = true;
    before = measure_stress(sheets_[p]);
  });
}

void Planning::search_panel(std::size_t p, int first_unit) {
  SearchTearsOptions search;
  search.stretch_limit = limit();
  search.least_strip = options_.candidates.least_strip;
  search.tear = options_.candidates.tear;
  search.tear.relaxation.max_renewals = 6;  // to compare sets, not to cut
  search.tear.relaxation.energy_drop = 1e-3;
  search.removing = options_.removing;
  for (const KeepOut& keep : pattern_.panels[p].keep_outs) search.keep_outs.push_back(keep.polygon);
  SheetEquations& equations = equations_of(memory_[p].coarse, sheets_[p], search.tear.relaxation.hold);
  search_tears(sheets_[p], units_.of_panel[p], first_unit, search, equations, memory_[p].tried[stretched_[p] ? 1 : 0],
               sets_[p], trials_[p], progress_);
}

void Planning::search_sides() {
  work_off(sheets_.size(), [&](std::size_t p) {
    if (!chooses(p)) return;
    if (locked(p)) units_.of_panel[p].clear();
    search_panel(p, 0);
  });
}

// Cuts are looked for only where sides alone leave too much, or many of them are needed.
void Planning::search_cuts() {
  std::vector<int> wanting;
  for (std::size_t p = 0; p < sheets_.size(); ++p) {
    if (!chooses(p) || locked(p)) continue;
    const bool easy = std::any_of(sets_[p].begin(), sets_[p].end(), [&](const TearSet& set) {
      return set.units.size() <= 2 && share_of_limit(set.stress, limit()) < kNearEnough;
    });
    if (!easy) wanting.push_back(static_cast<int>(p));
  }
  if (wanting.empty() || options_.choice.max_tears_per_side == 0) return;
  std::vector<std::size_t> known;
  for (const auto& units : units_.of_panel) known.push_back(units.size());
  CutUnitOptions cuts;
  cuts.max_tears_per_side = options_.choice.max_tears_per_side;
  cuts.seam_preference = options_.choice.seam_preference;
  cuts.least_cut_side = options_.candidates.least_cut_side;
  cuts.tear = options_.candidates.tear;
  add_cut_units(pattern_, sheets_, partners_, twins_, wanting, cuts, units_);
  work_off(sheets_.size(), [&](std::size_t p) {
    if (chooses(p) && units_.of_panel[p].size() > known[p]) search_panel(p, static_cast<int>(known[p]));
  });
}

void Planning::choose() {
  ChooseSetsOptions options;
  options.stretch_limit = limit();
  options.l_shapes = options_.choice.l_shapes;
  const ChosenSets chosen = choose_sets(sets_, units_, sheets_, partners_, twins_, options);
  for (std::size_t p = 0; p < sheets_.size(); ++p)
    if (chooses(p)) take_set(p, sets_[p][chosen.set_of_panel[p]]);
  for (const PanelTearing& panel : plan_.panels)
    for (const MadeTear& made : panel.tears) plan_.rounds = std::max(plan_.rounds, made.round + 1);
}

// Share of the panel's first energy that `last` releases after the other units.
double Planning::release_of(std::size_t p, std::vector<int> units, int last) const {
  const auto energy = [&](const std::vector<int>& wanted) {
    for (const TearSet& set : sets_[p])
      if (set.units == wanted) return set.stress.energy;
    return sets_[p].front().stress.energy;
  };
  std::sort(units.begin(), units.end());
  const double after = energy(units);
  std::erase(units, last);
  const double first = sets_[p].front().stress.energy;
  return first > 0.0 ? (energy(units) - after) / first : 0.0;
}

void Planning::take_set(std::size_t p, const TearSet& set) {
  // In the order of what each releases for itself, as single tears one after the other would go.
  std::vector<int> order = set.units;
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return release_of(p, {a}, a) > release_of(p, {b}, b); });
  std::vector<int> made;
  for (const int number : order) {
    made.push_back(number);
    const TearUnit& unit = units_.of_panel[p][static_cast<std::size_t>(number)];
    const auto place =
        static_cast<std::size_t>(std::find(set.units.begin(), set.units.end(), number) - set.units.begin());
    MadeTear tear;
    tear.round = static_cast<int>(made.size()) - 1;
    tear.weight = units_.job_cost[static_cast<std::size_t>(unit.job)] + unit.burden;
    tear.release = release_of(p, made, number);
    tear.largest_gap = set.largest_gaps[place];
    for (const Tear& own : unit.tears) {
      tear.tear = own;
      plan_.panels[p].tears.push_back(tear);
      plan_.jobs[p].push_back(unit.job);
      if (!twins_[p] || twins_[p]->panel == static_cast<int>(p)) continue;
      const auto twin = static_cast<std::size_t>(twins_[p]->panel);
      tear.tear = mirrored(own, *twins_[p], sheets_[p], sheets_[twin]);
      plan_.panels[twin].tears.push_back(tear);
      plan_.jobs[twin].push_back(unit.job);
    }
  }
}

// The same place on a side of another resolution.
Tear carried(const Tear& tear, const Sheet& from, const Sheet& to) {
  Tear same = tear;
  const auto side = static_cast<std::size_t>(tear.side);
  same.at *= to.cloth_sides[side].length() / from.cloth_sides[side].length();
  return same;
}

// The cloth of the plan, stretched, with the sides let go that the panel's tears let go.
Sheet released(const Sheet& planned, const PanelTearing& panel, const TearOptions& tearing, Progress* progress) {
  Sheet sheet = planned;
  std::vector<Tear> tears;
  for (const MadeTear& made : panel.tears)
    if (made.tear.kind == TearKind::Release) tears.push_back(made.tear);
  propagate_tears(sheet, tears, tearing, progress);
  return sheet;
}

// Carries out tears on the garment's own mesh, from where the plan's cloth lies.
CarriedOut carried_out(Sheet sheet, const Sheet& planned, const PanelTearing& panel, const std::vector<Tear>& tears,
                       const TearOptions& tearing, SheetEquations& equations, Progress* progress) {
  const bool stretched_first = tears.empty() || tears.back().kind == TearKind::Edge;
  if (planned.cuts.empty()) lay_like(sheet, stretched_first ? planned : released(planned, panel, tearing, progress));
  // Cuts find their way in cloth that lies as it will be stretched.
  if (stretched_first) relax(sheet, tearing.relaxation, progress, &equations);
  // Cuts come last, and in the sheet they stand in the order of their tears.
  std::vector<TearOutcome> outcomes = propagate_tears(sheet, tears, tearing, progress, &equations);
  return {planned, tears, std::move(sheet), std::move(outcomes)};
}

// Carries out a panel's tears; what does not open on the garment's own mesh is left out.
void carry_out(Sheet& sheet, const Sheet& planned, PanelTearing& panel, std::vector<int>& jobs,
               const TearPatternOptions& options, PanelMemory& memory, Progress* progress) {
  const TearOptions& tearing = options.candidates.tear;
  std::vector<Tear> tears;
  for (const MadeTear& made : panel.tears) tears.push_back(carried(made.tear, planned, sheet));
  auto known = std::find_if(memory.carried_out.begin(), memory.carried_out.end(), [&](const CarriedOut& other) {
    return other.tears == tears && lie_alike(other.planned, planned);
  });
  if (known == memory.carried_out.end())
    known = memory.carried_out.insert(known,
                                      carried_out(sheet, planned, panel, tears, tearing,
                                                  equations_of(memory.fine, sheet, tearing.relaxation.hold), progress));
  sheet = known->sheet;
  std::vector<MadeTear> made;
  std::vector<int> made_jobs;
  for (std::size_t i = 0; i < tears.size(); ++i) {
    if (!known->outcomes[i].opened) continue;
    made.push_back(panel.tears[i]);
    made.back().tear = tears[i];
    made.back().largest_gap = known->outcomes[i].largest_gap;
    made_jobs.push_back(jobs[i]);
  }
  panel.tears = std::move(made);
  jobs = std::move(made_jobs);
}

void conclude(const Sheet& sheet, bool locked, double limit, PanelTearing& panel) {
  panel.overlaps = !panel.tears.empty() && farthest_outside(sheet) > kMostOutside;
  panel.done = share_of_strain(panel.after, limit) < kNearEnough && !panel.overlaps;
  panel.reason = panel.done       ? ""
                 : locked         ? "the panel is locked"
                 : panel.overlaps ? "kept cloth overlaps the outline"
                                  : "no further tear would release enough of the stretch";
}

}  // namespace

TornPattern tear_pattern(const Pattern& pattern, const Stretching& fine, const Stretching& coarse,
                         const TearPatternOptions& options, TearMemory& memory, Progress* progress) {
  memory.resize(pattern.panels.size());
  const bool in_rounds = options.choice.greedy || options.candidates.weighting == TearWeighting::Boundary;
  std::vector<Sheet> sheets = make_sheets(pattern, fine), coarse_sheets = make_sheets(pattern, coarse, &sheets);
  std::vector<std::optional<PanelTwin>> twins(sheets.size());
  if (options.symmetric && !in_rounds) twins = find_panel_twins(pattern, coarse_sheets);
  for (std::vector<Sheet>* all : {&sheets, &coarse_sheets}) keep_in_the_middle(twins, *all);
  TornPattern torn =
      in_rounds
          ? tear_in_rounds(pattern, coarse.mesh, std::move(coarse_sheets), options, progress)
          : Planning(pattern, coarse.mesh, std::move(coarse_sheets), std::move(twins), options, memory, progress).run();
  const std::vector<Sheet> planned = std::move(torn.sheets);
  torn.sheets = std::move(sheets);
  const double limit = options.candidates.stretch_limit;
  work_off(torn.sheets.size(), [&](std::size_t p) {
    PanelTearing& panel = torn.panels[p];
    const bool tense = !panel.tears.empty() || share_of_limit(measure_stress(torn.sheets[p]), limit) >= 1.0;
    if (!pattern.panels[p].locked && tense)
      carry_out(torn.sheets[p], planned[p], panel, torn.jobs[p], options, memory[p], progress);
  });
  couple_plies(pattern, fine.mesh, fine.wanted, limit, options.candidates.tear.relaxation, torn.sheets, &memory,
               progress);
  work_off(torn.sheets.size(), [&](std::size_t p) {
    PanelTearing& panel = torn.panels[p];
    panel.after = measure_stress(torn.sheets[p]);
    conclude(torn.sheets[p], pattern.panels[p].locked, limit, panel);
  });
  return torn;
}

}  // namespace toile
