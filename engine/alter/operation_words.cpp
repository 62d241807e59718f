// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/operation_words.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace toile {
namespace {

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// The other ply of the side's first sewn edge.
const Panel* partner_panel(const Pattern& pattern, int panel, const PanelSide& side) {
  for (const int edge : side.edges) {
    const SeamSide name{PanelId(panel), edge};
    for (const Seam& seam : pattern.seams) {
      if (seam.a == name) return &pattern.panel(seam.b.panel);
      if (seam.b == name) return &pattern.panel(seam.a.panel);
    }
  }
  return nullptr;
}

std::string free_side_words(const Vec2& outward) {
  if (outward.y() < -0.7) return "hem";
  if (outward.y() > 0.7) return "upper edge";
  return "open edge";
}

std::string millimetres(double metres) {
  return std::to_string(std::lround(metres * kMmPerMetre)) + " mm";
}

}  // namespace

std::string side_words(const Pattern& pattern, const Sheet& sheet, int side) {
  const PanelSide& s = sheet.sides[static_cast<std::size_t>(side)];
  const Panel& panel = pattern.panels[static_cast<std::size_t>(sheet.panel)];
  for (const int edge : s.edges)
    if (const std::string& name = panel.edges[static_cast<std::size_t>(edge)].name; !name.empty()) return name;
  const Panel* other = partner_panel(pattern, sheet.panel, s);
  if (other == &panel) return "dart of " + readable(panel.name);
  if (other) {
    std::string a = readable(panel.name), b = readable(other->name);
    if (b < a) std::swap(a, b);
    return "seam of " + a + " and " + b;
  }
  const SideCurve& curve = sheet.cloth_sides[static_cast<std::size_t>(side)];
  const Vec2 outward = curve.closest(curve.point(0.5 * curve.length())).normal;
  return free_side_words(outward) + " of " + readable(panel.name);
}

std::string without_left_right(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t end = std::min(name.find_first_of("_ ", i), name.size());
    const std::string word = name.substr(i, end - i);
    if (word != "left" && word != "right" && word != "l" && word != "r") result += (result.empty() ? "" : " ") + word;
    i = end + 1;
  }
  return result;
}

std::string place_words(const Vec2& point, const std::vector<Vec2>& outline) {
  double low = point.y(), high = point.y();
  for (const Vec2& p : outline) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const double share = high > low ? (point.y() - low) / (high - low) : 0.5;
  return share > 0.67 ? "at the top" : share < 0.33 ? "at the bottom" : "in the middle";
}

std::string operation_sentence(const TicketOperation& o) {
  std::string text = o.where;
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  text += ": " + std::string(operation_words(o.kind)) + " " + millimetres(o.per_ply);
  if (o.total > 1.001 * o.per_ply) text += " per ply (" + millimetres(o.total) + " in all)";
  if (!o.largest_at.empty()) text += " " + o.largest_at;
  if (!o.tapers_to.empty()) text += ", tapering to nothing " + o.tapers_to;
  if (o.taper_length > 0.0) text += ", " + millimetres(o.taper_length) + " away";
  if (o.fabric == FabricNeed::WithinAllowance) text += "; the seam allowance gives it";
  if (o.fabric == FabricNeed::NeedsFabric) text += "; needs cloth";
  return text + ".";
}

}  // namespace toile
