// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/choose_tears.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/numerics/integer_program.h"

namespace toile {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSamePlace = 0.02;     // m, along a seam
constexpr double kOpenSeamPrice = 0.6;  // share of a tear's weight that an unmatched ply costs
constexpr double kCornerPrice = 0.8;    // share of its weight that a side keeps whose neighbour is released already
constexpr double kOnlyForPartner = -1e-3;

bool neighbour_released(const PanelTears& done, int side, int step) {
  const int count = static_cast<int>(done.released.size());
  return count > 1 && done.released[static_cast<std::size_t>((side + step + count) % count)];
}

std::string refusal(const TearCandidate& candidate, const Sheet& sheet, const PanelTears& done,
                    const ChooseTearsOptions& options) {
  const int side = candidate.tear.side, count = static_cast<int>(done.released.size());
  if (candidate.tear.kind == TearKind::Edge)
    return done.edge_tears[static_cast<std::size_t>(side)] >= options.max_tears_per_side ? "side is cut often enough"
                                                                                         : "";
  for (const int step : {-1, 1}) {
    const int next = (side + step + count) % count;
    if (sheet.cloth_sides[static_cast<std::size_t>(next)].length() < options.least_corner_distance && count > 3 &&
        neighbour_released(done, side, 2 * step))
      return "corner too near to one already torn";
  }
  return "";
}

double weight_of(const TearCandidate& candidate, const std::vector<PanelTears>& done,
                 const ChooseTearsOptions& options) {
  if (candidate.weight <= 0.0 || candidate.release < options.least_release)
    return std::min(candidate.weight, 0.0) + kOnlyForPartner;
  if (candidate.tear.kind == TearKind::Edge) return candidate.weight;
  const PanelTears& panel = done[static_cast<std::size_t>(candidate.tear.panel)];
  const bool corner =
      neighbour_released(panel, candidate.tear.side, 1) || neighbour_released(panel, candidate.tear.side, -1);
  return candidate.weight * options.seam_preference * (corner && !options.l_shapes ? kCornerPrice : 1.0);
}

class Program {
 public:
  Program(const std::vector<TearCandidate>& candidates, const std::vector<Sheet>& sheets,
          const std::vector<PanelTears>& done, const std::vector<std::vector<SeamPartner>>& partners,
          const ChooseTearsOptions& options)
      : candidates_(candidates), sheets_(sheets), done_(done), partners_(partners), options_(options) {
    for (const TearCandidate& candidate : candidates) program_.weights.push_back(weight_of(candidate, done, options));
    forbid_refused();
    limit_panels_and_sides();
    for (std::size_t c = 0; c < candidates.size(); ++c)
      if (candidates[c].refused.empty()) match_seams(c);
  }

  ChosenTears solve() const;

 private:
  void forbid_refused();
  void limit_panels_and_sides();
  void match_seams(std::size_t c);

  const std::vector<TearCandidate>& candidates_;
  const std::vector<Sheet>& sheets_;
  const std::vector<PanelTears>& done_;
  const std::vector<std::vector<SeamPartner>>& partners_;
  const ChooseTearsOptions& options_;
  IntegerProgram program_;
};

void Program::forbid_refused() {
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (!candidates_[c].refused.empty()) program_.constraints.push_back({{{static_cast<int>(c), 1.0}}, 0.0, 0.0});
}

void Program::limit_panels_and_sides() {
  std::map<int, IntegerConstraint> panels;
  std::map<std::pair<int, int>, IntegerConstraint> sides;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const Tear& tear = candidates_[c].tear;
    panels[tear.panel].terms.emplace_back(static_cast<int>(c), 1.0);
    if (tear.kind == TearKind::Edge) sides[{tear.panel, tear.side}].terms.emplace_back(static_cast<int>(c), 1.0);
  }
  for (auto& [panel, row] : panels) program_.constraints.push_back({row.terms, -kInfinite, 1.0});
  for (auto& [side, row] : sides) {
    const int used = done_[static_cast<std::size_t>(side.first)].edge_tears[static_cast<std::size_t>(side.second)];
    program_.constraints.push_back(
        {row.terms, -kInfinite, static_cast<double>(std::max(0, options_.max_tears_per_side - used))});
  }
}

// c <= sum of what opens the other ply there + slack; the slack costs.
void Program::match_seams(std::size_t c) {
  const TearCandidate& candidate = candidates_[c];
  for (const TearMouth& mouth : candidate.outcome.mouths)
    for (const PartnerPlace& partner : partner_places(sheets_, partners_, candidate.tear.panel, mouth)) {
      const Sheet& sheet = sheets_[static_cast<std::size_t>(partner.panel)];
      if (opens_at(sheet, done_[static_cast<std::size_t>(partner.panel)].mouths, partner.places)) continue;
      if (partner.panel == candidate.tear.panel && opens_at(sheet, candidate.outcome.mouths, partner.places)) continue;
      IntegerConstraint row{{{static_cast<int>(c), 1.0}}, -kInfinite, 0.0};
      for (std::size_t d = 0; d < candidates_.size(); ++d)
        if (d != c && candidates_[d].refused.empty() && candidates_[d].tear.panel == partner.panel &&
            opens_at(sheet, candidates_[d].outcome.mouths, partner.places))
          row.terms.emplace_back(static_cast<int>(d), -1.0);
      row.terms.emplace_back(static_cast<int>(program_.weights.size()), -1.0);
      program_.weights.push_back(-kOpenSeamPrice * std::max(0.0, program_.weights[c]));
      program_.constraints.push_back(std::move(row));
    }
}

ChosenTears Program::solve() const {
  const IntegerSolution solution = solve_integer_program(program_);
  ChosenTears chosen;
  chosen.value = solution.value;
  if (!solution.feasible) return chosen;
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (solution.chosen[c]) chosen.candidates.push_back(c);
  return chosen;
}

ChosenTears choose_greedily(const std::vector<TearCandidate>& candidates, const std::vector<PanelTears>& done,
                            const ChooseTearsOptions& options) {
  std::map<int, std::size_t> best;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!candidates[c].refused.empty() || weight_of(candidates[c], done, options) <= 0.0) continue;
    const auto [known, added] = best.emplace(candidates[c].tear.panel, c);
    if (!added && weight_of(candidates[c], done, options) > weight_of(candidates[known->second], done, options))
      known->second = c;
  }
  ChosenTears chosen;
  for (const auto& [panel, c] : best) {
    chosen.candidates.push_back(c);
    chosen.value += weight_of(candidates[c], done, options);
  }
  std::sort(chosen.candidates.begin(), chosen.candidates.end());
  return chosen;
}

}  // namespace

std::vector<PartnerPlace> partner_places(const std::vector<Sheet>& sheets,
                                         const std::vector<std::vector<SeamPartner>>& partners, int panel,
                                         const TearMouth& mouth) {
  const Sheet& sheet = sheets[static_cast<std::size_t>(panel)];
  const std::vector<double>& at = sheet.cloth_sides[static_cast<std::size_t>(mouth.side)].at();
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < at.size(); ++i)
    if (std::abs(at[i] - mouth.at) < std::abs(at[nearest] - mouth.at)) nearest = i;
  const int vertex = sheet.sides[static_cast<std::size_t>(mouth.side)].vertices[nearest];
  std::vector<PartnerPlace> result;
  for (const SeamPartner& partner : partners[static_cast<std::size_t>(vertex)]) {
    const Sheet& other = sheets[static_cast<std::size_t>(partner.panel)];
    PartnerPlace place{partner.panel, {}};
    for (std::size_t s = 0; s < other.sides.size(); ++s) {
      const std::vector<int>& outline = other.sides[s].vertices;
      const auto found = std::find(outline.begin(), outline.end(), partner.vertex);
      if (found != outline.end())
        place.places.push_back(
            {static_cast<int>(s), other.cloth_sides[s].at()[static_cast<std::size_t>(found - outline.begin())]});
    }
    if (!place.places.empty()) result.push_back(std::move(place));
  }
  return result;
}

bool opens_at(const Sheet& sheet, const std::vector<TearMouth>& mouths, const std::vector<TearMouth>& places) {
  const double reach = std::max(kSamePlace, 2.0 * sheet.edge_length);
  return std::any_of(mouths.begin(), mouths.end(), [&](const TearMouth& mouth) {
    return std::any_of(places.begin(), places.end(), [&](const TearMouth& place) {
      return mouth.side == place.side && std::abs(mouth.at - place.at) <= reach;
    });
  });
}

ChosenTears choose_tears(std::vector<TearCandidate>& candidates, const std::vector<Sheet>& sheets,
                         const std::vector<PanelTears>& done, const std::vector<std::vector<SeamPartner>>& partners,
                         const ChooseTearsOptions& options) {
  for (TearCandidate& candidate : candidates) {
    const auto panel = static_cast<std::size_t>(candidate.tear.panel);
    if (candidate.refused.empty()) candidate.refused = refusal(candidate, sheets[panel], done[panel], options);
  }
  if (options.greedy) return choose_greedily(candidates, done, options);
  return Program(candidates, sheets, done, partners, options).solve();
}

}  // namespace toile
