// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/side_rules.h"

#include <cmath>

namespace toile {
namespace {

constexpr double kGrainParallel = 0.02;  // sine of the angle within which an edge runs along the grain: a degree

SideRule& rule_of(SideRules& rules, const SeamSide& side) {
  return rules[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)];
}

// The legs of a dart are neighbours on one panel, sewn so that the corner between them meets itself.
void mark_dart(const Pattern& pattern, const Seam& seam, SideRules& rules) {
  if (seam.a.panel != seam.b.panel || seam.right_wrong) return;
  const int edges = pattern.panel(seam.a.panel).edge_count();
  for (const auto& [first, second] : {std::pair{seam.a, seam.b}, std::pair{seam.b, seam.a}})
    if ((first.edge + 1) % edges == second.edge)
      rule_of(rules, first).dart_tip = rule_of(rules, second).dart_tip = second.edge;
}

bool runs_along_grain(const Panel& panel, int e) {
  const Vec2 grain = panel.grainline ? Vec2((*panel.grainline)[1] - (*panel.grainline)[0]) : Vec2(0, 1);
  const Vec2 way = panel.edge_end(e) - panel.edge_start(e);
  return std::abs(grain.x() * way.y() - grain.y() * way.x()) < kGrainParallel * grain.norm() * way.norm();
}

bool stays_straight(const Panel& panel, int e, const SideRule& rule, bool detect) {
  const PanelEdge& edge = panel.edges[static_cast<std::size_t>(e)];
  if (edge.curve.kind != CurveKind::Line) return false;
  if (edge.straight) return *edge.straight;
  if (edge.on_fold) return true;
  return detect && (edge.hem || !rule.sewn || rule.dart_tip >= 0 || runs_along_grain(panel, e));
}

}  // namespace

bool panel_locked(const Pattern& pattern, const GarmentMirrors& mirrors, int panel) {
  const PanelImage* image = mirrors.image_of(panel);
  return pattern.panels[static_cast<std::size_t>(panel)].locked ||
         (image && pattern.panels[static_cast<std::size_t>(image->panel)].locked);
}

SideRules side_rules(const Pattern& pattern, const GarmentMirrors& mirrors, bool keep_straight) {
  SideRules rules;
  for (const Panel& panel : pattern.panels) rules.emplace_back(panel.edges.size());
  for (const Seam& seam : pattern.seams) {
    rule_of(rules, seam.a).sewn = rule_of(rules, seam.b).sewn = true;
    mark_dart(pattern, seam, rules);
  }
  for (std::size_t p = 0; p < rules.size(); ++p)
    for (std::size_t e = 0; e < rules[p].size(); ++e) {
      const Panel& panel = pattern.panels[p];
      rules[p][e].locked = panel.locked || panel.edges[e].locked || panel.edges[e].zip;
      rules[p][e].straight = stays_straight(panel, static_cast<int>(e), rules[p][e], keep_straight);
    }
  const SideRules own = rules;
  for (std::size_t p = 0; p < rules.size(); ++p) {
    const PanelImage* image = mirrors.image_of(static_cast<int>(p));
    if (!image) continue;
    for (std::size_t e = 0; e < rules[p].size(); ++e) {
      const SideRule& other = own[static_cast<std::size_t>(image->panel)][static_cast<std::size_t>(image->edge_of[e])];
      rules[p][e].locked |= other.locked;
      rules[p][e].straight |= other.straight;
    }
  }
  return rules;
}

}  // namespace toile
