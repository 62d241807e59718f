// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_in_rounds.h"

#include <algorithm>

#include "engine/alter/search_tears.h"

namespace toile {
namespace {

class Tearing {
 public:
  Tearing(const Pattern& pattern, const PatternMesh& mesh, std::vector<Sheet> sheets, const TearPatternOptions& options,
          Progress* progress)
      : options_(options), progress_(progress), partners_(find_seam_partners(mesh)), first_(std::move(sheets)) {
    for (std::size_t p = 0; p < first_.size(); ++p) {
      const std::size_t sides = first_[p].sides.size();
      done_.push_back({std::vector<bool>(sides, false), std::vector<int>(sides, 0), {}});
      locked_.push_back(pattern.panels[p].locked);
    }
    trials_.resize(first_.size());
    fresh_.assign(first_.size(), false);
    result_.panels.resize(first_.size());
    result_.jobs.resize(first_.size());
  }

  TornPattern run(const Pattern& pattern);

 private:
  double limit() const { return options_.candidates.stretch_limit; }
  void stretch_all();
  bool within(const SheetStress& stress) const { return stress.p95 < limit() && share_of_shift(stress, limit()) < 1.0; }
  bool active(std::size_t p) const { return !locked_[p] && !within(result_.panels[p].after); }
  void try_panel(std::size_t p);
  void try_partners();
  void try_partner(const PartnerPlace& partner);
  bool round();
  void adopt(const TearCandidate& candidate, int round);
  void undo_redundant(std::size_t p);
  bool replay(std::size_t p, std::size_t without, Sheet& sheet);
  void conclude();
  void number_jobs(const Pattern& pattern);

  const TearPatternOptions& options_;
  Progress* progress_;
  std::vector<std::vector<SeamPartner>> partners_;
  std::vector<Sheet> first_;  // stretched, not torn
  std::vector<PanelTears> done_;
  std::vector<bool> locked_;
  std::vector<std::vector<TearCandidate>> trials_;  // per panel, valid until it is torn
  std::vector<bool> fresh_;
  TornPattern result_;
};

void Tearing::stretch_all() {
  for (std::size_t p = 0; p < first_.size(); ++p) {
    PanelTearing& panel = result_.panels[p];
    panel.before = measure_stress(first_[p]);
    // The plain map is the start; where it has no tension it stays, and there is nothing to relax.
    if (!locked_[p] && !within(panel.before)) {
      relax(first_[p], options_.candidates.tear.relaxation, progress_);
      panel.before = measure_stress(first_[p]);
    }
    panel.after = panel.before;
  }
  result_.sheets = first_;
}

void Tearing::try_panel(std::size_t p) {
  if (fresh_[p]) return;
  trials_[p].clear();
  fresh_[p] = true;
  const Sheet& sheet = result_.sheets[p];
  for (const Tear& tear :
       possible_tears(sheet, done_[p].edge_tears, options_.choice.max_tears_per_side, options_.candidates)) {
    trials_[p].push_back(try_tear(sheet, tear, result_.panels[p].after, result_.panels[p].before.energy,
                                  options_.candidates, progress_));
    ++result_.trials;
  }
}

// What the other ply would have to do where a candidate opens a seam, if nothing there does it yet.
void Tearing::try_partners() {
  for (std::size_t p = 0; p < trials_.size(); ++p) {
    if (!active(p)) continue;
    const std::vector<TearCandidate> candidates = trials_[p];
    for (const TearCandidate& candidate : candidates) {
      if (!candidate.refused.empty()) continue;
      for (const TearMouth& mouth : candidate.outcome.mouths)
        for (const PartnerPlace& partner : partner_places(result_.sheets, partners_, static_cast<int>(p), mouth))
          try_partner(partner);
    }
  }
}

void Tearing::try_partner(const PartnerPlace& partner) {
  const auto p = static_cast<std::size_t>(partner.panel);
  const Sheet& sheet = result_.sheets[p];
  if (locked_[p] || opens_at(sheet, done_[p].mouths, partner.places)) return;
  for (const TearCandidate& known : trials_[p])
    if (known.refused.empty() && opens_at(sheet, known.outcome.mouths, partner.places)) return;
  const auto add = [&](const Tear& tear) {
    const bool tried = std::any_of(trials_[p].begin(), trials_[p].end(), [&](const TearCandidate& known) {
      return known.tear.kind == tear.kind && known.tear.side == tear.side &&
             std::abs(known.tear.at - tear.at) < sheet.edge_length;
    });
    if (tried) return;
    trials_[p].push_back(try_tear(sheet, tear, result_.panels[p].after, result_.panels[p].before.energy,
                                  options_.candidates, progress_));
    ++result_.trials;
  };
  if (partner.places.size() > 1) {  // a corner: let one of its sides go
    for (const TearMouth& place : partner.places)
      if (!sheet.sides[static_cast<std::size_t>(place.side)].locked)
        add({TearKind::Release, partner.panel, place.side, 0.0, Vec2::Zero()});
    return;
  }
  const TearMouth& place = partner.places.front();
  if (sheet.sides[static_cast<std::size_t>(place.side)].locked) return;
  const int start = vertex_on_side(sheet, place.side, place.at);
  if (start >= 0)
    add({TearKind::Edge, partner.panel, place.side, place.at, tear_direction(sheet, start, options_.candidates.tear)});
}

void Tearing::adopt(const TearCandidate& candidate, int round) {
  const auto p = static_cast<std::size_t>(candidate.tear.panel);
  const auto side = static_cast<std::size_t>(candidate.tear.side);
  result_.sheets[p] = candidate.after;
  result_.panels[p].after = candidate.stress;
  result_.panels[p].tears.push_back({candidate.tear, round, candidate.weight, candidate.release,
                                     candidate.outcome.largest_gap, candidate.release < options_.choice.least_release});
  if (candidate.tear.kind == TearKind::Release)
    done_[p].released[side] = true;
  else
    ++done_[p].edge_tears[side];
  const auto& mouths = candidate.outcome.mouths;
  done_[p].mouths.insert(done_[p].mouths.end(), mouths.begin(), mouths.end());
  fresh_[p] = false;
  trials_[p].clear();
}

bool Tearing::round() {
  bool any = false;
  for (std::size_t p = 0; p < first_.size(); ++p)
    if (active(p)) {
      try_panel(p);
      any = true;
    }
  if (!any) return false;
  if (!options_.choice.greedy) try_partners();
  std::vector<TearCandidate> all;
  for (const auto& trials : trials_) all.insert(all.end(), trials.begin(), trials.end());
  const ChosenTears chosen = choose_tears(all, result_.sheets, done_, partners_, options_.choice);
  if (chosen.candidates.empty()) return false;
  for (const std::size_t c : chosen.candidates) adopt(all[c], result_.rounds);
  ++result_.rounds;
  return true;
}

// Carries out all tears of a panel but one on the untorn sheet.
bool Tearing::replay(std::size_t p, std::size_t without, Sheet& sheet) {
  sheet = first_[p];
  const std::vector<MadeTear>& tears = result_.panels[p].tears;
  for (std::size_t i = 0; i < tears.size(); ++i)
    if (i != without && !propagate_tear(sheet, tears[i].tear, options_.candidates.tear, progress_).opened) return false;
  return within(measure_stress(sheet));
}

void Tearing::undo_redundant(std::size_t p) {
  std::vector<MadeTear>& tears = result_.panels[p].tears;
  for (std::size_t i = 0; tears.size() > 1 && i < tears.size();) {
    Sheet sheet;
    if (tears[i].for_partner || !replay(p, i, sheet)) {
      ++i;
      continue;
    }
    tears.erase(tears.begin() + static_cast<std::ptrdiff_t>(i));
    result_.sheets[p] = std::move(sheet);
    result_.panels[p].after = measure_stress(result_.sheets[p]);
    ++result_.reverted;
  }
}

void Tearing::conclude() {
  for (std::size_t p = 0; p < first_.size(); ++p) {
    PanelTearing& panel = result_.panels[p];
    if (within(panel.after)) undo_redundant(p);
    panel.done = panel.after.p95 < kNearEnough * limit();
    if (panel.done) continue;
    panel.reason = locked_[p] ? "the panel is locked" : "no further tear would release enough of the stretch";
  }
}

// Sides by the seams they belong to; every cut for itself.
void Tearing::number_jobs(const Pattern& pattern) {
  const TearUnits units = side_units(pattern, first_, partners_, find_panel_twins(pattern, first_));
  int next = static_cast<int>(units.job_cost.size());
  for (std::size_t p = 0; p < first_.size(); ++p)
    for (const MadeTear& made : result_.panels[p].tears)
      result_.jobs[p].push_back(
          made.tear.kind == TearKind::Edge ? next++ : units.side_jobs[p][static_cast<std::size_t>(made.tear.side)]);
}

TornPattern Tearing::run(const Pattern& pattern) {
  stretch_all();
  for (int i = 0; i < options_.max_rounds; ++i) {
    report(progress_, "alter", static_cast<double>(i) / options_.max_rounds);
    if (!round()) break;
  }
  conclude();
  number_jobs(pattern);
  return std::move(result_);
}

}  // namespace

TornPattern tear_in_rounds(const Pattern& pattern, const PatternMesh& mesh, std::vector<Sheet> sheets,
                           const TearPatternOptions& options, Progress* progress) {
  return Tearing(pattern, mesh, std::move(sheets), options, progress).run(pattern);
}

}  // namespace toile
