// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/choose_sets.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "engine/core/error.h"
#include "engine/numerics/integer_program.h"

namespace toile {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kMostExcess = 4.0;     // times the limit: beyond it worse is not dearer
constexpr double kStretchShare = 0.05;  // jobs: among equal sets the one that leaves less

class Program {
 public:
  Program(const std::vector<std::vector<TearSet>>& sets, const TearUnits& units, const std::vector<Sheet>& sheets,
          const std::vector<std::vector<SeamPartner>>& partners, const std::vector<std::optional<PanelTwin>>& twins,
          const ChooseSetsOptions& options)
      : sets_(sets), units_(units), sheets_(sheets), partners_(partners), twins_(twins), options_(options) {
    for (std::size_t p = 0; p < sets.size(); ++p) add_panel(p);
    for (const auto& [job, users] : users_of_job_) add_job(job, users);
    for (std::size_t p = 0; p < sets.size(); ++p)
      if (!sets[p].empty()) match_plies(p);
  }

  // No more jobs than `other` does, an answer to the same program with other prices.
  void limit_jobs_to(const ChosenSets& other) {
    std::set<int> done;
    for (std::size_t p = 0; p < sets_.size(); ++p) {
      if (sets_[p].empty()) continue;
      for (const int unit : sets_[p][other.set_of_panel[p]].units)
        done.insert(units_.of_panel[p][static_cast<std::size_t>(unit)].job);
    }
    IntegerConstraint row{{}, -kInfinite, static_cast<double>(done.size())};
    for (const int y : done_) row.terms.emplace_back(y, 1.0);
    program_.constraints.push_back(std::move(row));
  }

  // Nothing where no choice was found.
  std::optional<ChosenSets> solve() const {
    const IntegerSolution solution = solve_integer_program(program_);
    if (!solution.feasible) return std::nullopt;
    ChosenSets chosen{std::vector<std::size_t>(sets_.size(), 0), -solution.value};
    for (std::size_t p = 0; p < sets_.size(); ++p)
      for (std::size_t s = 0; s < sets_[p].size(); ++s)
        if (solution.chosen[static_cast<std::size_t>(variable(p, s))]) chosen.set_of_panel[p] = s;
    return chosen;
  }

 private:
  int add_variable(double cost) {
    program_.weights.push_back(-cost);
    return static_cast<int>(program_.weights.size()) - 1;
  }
  int variable(std::size_t panel, std::size_t set) const { return first_[panel] + static_cast<int>(set); }

  void add_panel(std::size_t p) {
    first_.push_back(static_cast<int>(program_.weights.size()));
    if (sets_[p].empty()) return;
    std::vector<int> plies;
    for (const PanelSide& side : sheets_[p].sides)
      plies.push_back(1 + static_cast<int>(partners_[static_cast<std::size_t>(side.vertices.back())].size()));
    IntegerConstraint one{{}, 1.0, 1.0};
    for (std::size_t s = 0; s < sets_[p].size(); ++s) {
      const int z = add_variable(set_burden(sets_[p][s], units_.of_panel[p], plies, options_));
      one.terms.emplace_back(z, 1.0);
      for (const int unit : sets_[p][s].units)
        users_of_job_[units_.of_panel[p][static_cast<std::size_t>(unit)].job][p].insert(z);
    }
    program_.constraints.push_back(std::move(one));
  }

  // A panel takes one set, so the sets of a panel that need the job are at most one together.
  void add_job(int job, const std::map<std::size_t, std::set<int>>& users) {
    const int y = add_variable(units_.job_cost[static_cast<std::size_t>(job)]);
    done_.push_back(y);
    for (const auto& [panel, sets] : users) {
      IntegerConstraint row{{}, -kInfinite, 0.0};
      for (const int z : sets) row.terms.emplace_back(z, 1.0);
      row.terms.emplace_back(y, -1.0);
      program_.constraints.push_back(std::move(row));
    }
  }

  // Sets of panel r (or of the twin that chooses for it) that open one of these places of r.
  std::vector<int> openers(const PartnerPlace& partner) const {
    const auto r = static_cast<std::size_t>(partner.panel), c = static_cast<std::size_t>(units_.chooser[r]);
    std::vector<TearMouth> places = partner.places;
    if (c != r)
      for (TearMouth& place : places) {
        const Tear image = mirrored({TearKind::Edge, partner.panel, place.side, place.at, Vec2::UnitX()}, *twins_[r],
                                    sheets_[r], sheets_[c]);
        place = {image.side, image.at};
      }
    std::vector<int> variables;
    for (std::size_t s = 0; s < sets_[c].size(); ++s)
      if (opens_at(sheets_[c], sets_[c][s].mouths, places)) variables.push_back(variable(c, s));
    return variables;
  }

  // Every place that some set of panel p opens, with the sets that do.
  void match_plies(std::size_t p) {
    std::vector<TearMouth> places;
    for (const TearSet& set : sets_[p])
      for (const TearMouth& mouth : set.mouths)
        if (!opens_at(sheets_[p], places, {mouth})) places.push_back(mouth);
    for (const TearMouth& place : places) {
      std::vector<int> own;
      for (std::size_t s = 0; s < sets_[p].size(); ++s)
        if (opens_at(sheets_[p], sets_[p][s].mouths, {place})) own.push_back(variable(p, s));
      for (const PartnerPlace& partner : partner_places(sheets_, partners_, static_cast<int>(p), place)) {
        std::map<int, double> terms;
        for (const int z : own) terms[z] += 1.0;
        for (const int z : openers(partner)) terms[z] -= 1.0;
        std::erase_if(terms, [](const auto& term) { return term.second == 0.0; });
        if (std::none_of(terms.begin(), terms.end(), [](const auto& term) { return term.second > 0.0; })) continue;
        IntegerConstraint row{{terms.begin(), terms.end()}, -kInfinite, 0.0};
        row.terms.emplace_back(add_variable(options_.open_price), -1.0);
        program_.constraints.push_back(std::move(row));
      }
    }
  }

  const std::vector<std::vector<TearSet>>& sets_;
  const TearUnits& units_;
  const std::vector<Sheet>& sheets_;
  const std::vector<std::vector<SeamPartner>>& partners_;
  const std::vector<std::optional<PanelTwin>>& twins_;
  const ChooseSetsOptions& options_;
  std::vector<int> first_;
  std::map<int, std::map<std::size_t, std::set<int>>> users_of_job_;
  std::vector<int> done_;  // y of every job that a set needs
  IntegerProgram program_;
};

}  // namespace

double set_burden(const TearSet& set, const std::vector<TearUnit>& units, const std::vector<int>& plies,
                  const ChooseSetsOptions& options) {
  const double share = share_of_limit(set.stress, options.stretch_limit);
  double cost = options.excess_price * std::clamp(share - 1.0, 0.0, kMostExcess) + kStretchShare * std::min(share, 1.0);
  if (share > options.near_enough) cost += options.undone_price;
  cost += options.lean_price * std::min(share_of_lean(set.stress, options.stretch_limit), kMostExcess);
  std::vector<bool> released(plies.size(), false);
  for (const int unit : set.units) {
    cost += units[static_cast<std::size_t>(unit)].burden;
    for (const Tear& tear : units[static_cast<std::size_t>(unit)].tears)
      if (tear.kind == TearKind::Release) released[static_cast<std::size_t>(tear.side)] = true;
  }
  if (options.l_shapes || plies.size() < 2) return cost;
  for (std::size_t s = 0; s < released.size(); ++s)
    if (released[s] && released[(s + 1) % released.size()]) {
      const int others = std::max(1, plies[s] - 1);
      cost += options.corner_price * others * others;
    }
  return cost;
}

ChosenSets choose_sets(const std::vector<std::vector<TearSet>>& sets, const TearUnits& units,
                       const std::vector<Sheet>& sheets, const std::vector<std::vector<SeamPartner>>& partners,
                       const std::vector<std::optional<PanelTwin>>& twins, const ChooseSetsOptions& options) {
  ChooseSetsOptions without_lean = options;
  without_lean.lean_price = 0.0;
  const auto fewest = Program(sets, units, sheets, partners, twins, without_lean).solve();
  if (!fewest)
    throw Error(ErrorCode::AlterationFailed, "integer_program", "no choice of tears was found; raise stretch_limit");
  Program program(sets, units, sheets, partners, twins, options);
  program.limit_jobs_to(*fewest);
  return program.solve().value_or(*fewest);
}

}  // namespace toile
