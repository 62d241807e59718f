// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_candidates.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

bool torn_off(const Sheet& sheet, int side) {
  return std::any_of(sheet.vertices.begin(), sheet.vertices.end(), [&](const SheetVertex& vertex) {
    const SheetAnchor* anchor = vertex.anchor(side);
    return anchor && !anchor->attached;
  });
}

// Mean tangential stretch of the faces on the border: of the whole side next to `side` for a release, since letting a
// side go relaxes what pulls across it; of the side itself around the start for an edge tear.
double boundary_stress(const Sheet& sheet, const Tear& tear, double radius) {
  const int count = static_cast<int>(sheet.sides.size());
  double sum = 0.0, length = 0.0;
  for (const BorderEdge& edge : border_edges(sheet)) {
    if (edge.side < 0) continue;
    const bool neighbour = edge.side == (tear.side + 1) % count || edge.side == (tear.side + count - 1) % count;
    const SheetVertex &a = sheet.vertices[static_cast<std::size_t>(edge.from)],
                      &b = sheet.vertices[static_cast<std::size_t>(edge.to)];
    if (tear.kind == TearKind::Release ? !neighbour : edge.side != tear.side) continue;
    if (tear.kind == TearKind::Edge && std::abs(a.anchor(edge.side)->at - tear.at) > radius) continue;
    const double flat = (b.flat - a.flat).norm(), now = (b.now - a.now).norm();
    sum += std::max(0.0, now - flat);
    length += flat;
  }
  return length > 0.0 ? sum / length : 0.0;
}

bool opens_locked_side(const Sheet& sheet, const TearOutcome& outcome) {
  return std::any_of(outcome.mouths.begin(), outcome.mouths.end(),
                     [&](const TearMouth& mouth) { return sheet.sides[static_cast<std::size_t>(mouth.side)].locked; });
}

}  // namespace

std::vector<Tear> possible_tears(const Sheet& sheet, const std::vector<int>& edge_tears, int theta,
                                 const CandidateOptions& options) {
  std::vector<Tear> tears;
  for (std::size_t s = 0; s < sheet.sides.size(); ++s) {
    const int side = static_cast<int>(s);
    if (sheet.sides[s].locked) continue;
    if (!torn_off(sheet, side)) tears.push_back({TearKind::Release, sheet.panel, side, 0.0, Vec2::Zero()});
    if (edge_tears[s] >= theta || sheet.cloth_sides[s].length() < options.least_cut_side) continue;
    const int start = vertex_on_side(sheet, side, 0.5 * sheet.cloth_sides[s].length());
    if (start < 0) continue;
    const double at = sheet.vertices[static_cast<std::size_t>(start)].anchor(side)->at;
    tears.push_back({TearKind::Edge, sheet.panel, side, at, tear_direction(sheet, start, options.tear)});
  }
  return tears;
}

TearCandidate try_tear(const Sheet& sheet, const Tear& tear, const SheetStress& before, double first_energy,
                       const CandidateOptions& options, Progress* progress) {
  TearCandidate candidate;
  candidate.tear = tear;
  candidate.after = sheet;
  candidate.outcome = propagate_tear(candidate.after, tear, options.tear, progress);
  candidate.stress = measure_stress(candidate.after);
  candidate.release = first_energy > 0.0 ? (before.energy - candidate.stress.energy) / first_energy : 0.0;
  candidate.weight = options.weighting == TearWeighting::Release
                         ? candidate.release
                         : boundary_stress(sheet, tear, options.tear.stress_radius);
  if (!candidate.outcome.opened)
    candidate.refused = "nothing opens";
  else if (opens_locked_side(sheet, candidate.outcome))
    candidate.refused = "opens a locked side";
  else if (tear.kind == TearKind::Edge && candidate.outcome.largest_gap < options.least_strip)
    candidate.refused = "narrower than a strip worth sewing";
  return candidate;
}

}  // namespace toile
