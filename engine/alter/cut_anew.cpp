// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/cut_anew.h"

#include <algorithm>
#include <limits>

#include "engine/alter/alter_pattern.h"
#include "engine/alter/search_tears.h"
#include "engine/core/text.h"

namespace toile {
namespace {

constexpr double kHopeless = 2.0;  // times the allowed stretch

std::string hopeless_pass(const PanelTearing& tearing, const char* pass, double stretch_limit) {
  if (tearing.done || (!tearing.overlaps && share_of_strain(tearing.after, stretch_limit) < kHopeless)) return {};
  return print_text("%s leaves %.0f %% stretch; ", pass, 100.0 * tearing.after.p95) + tearing.reason;
}

double turned_in(const PanelEdge& edge, double seam_allowance) {
  return edge.hem ? *edge.hem : edge.seam_allowance.value_or(seam_allowance);
}

}  // namespace

std::string hopeless(const PanelAlteration& panel, double stretch_limit) {
  const std::string inserting = hopeless_pass(panel.insertion_pass, "inserting", stretch_limit);
  return inserting.empty() ? hopeless_pass(panel.removal_pass, "removing", stretch_limit) : inserting;
}

std::optional<PolygonPlace> place_in_own_cloth(const Panel& panel, double seam_allowance,
                                               const std::vector<Vec2>& original, const std::vector<Vec2>& target) {
  // What is cut on the fold is one piece only where the fold is.
  if (std::any_of(panel.edges.begin(), panel.edges.end(), [](const PanelEdge& edge) { return edge.on_fold; }))
    return std::nullopt;
  if (const auto straight = place_inside(original, target, false)) return straight;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const PanelEdge& edge : panel.edges) {
    least = std::min(least, turned_in(edge, seam_allowance));
    most = std::max(most, turned_in(edge, seam_allowance));
  }
  return place_inside(original, target, true, std::max(0.0, most - least));
}

}  // namespace toile
