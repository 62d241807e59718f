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

Vec2 outward_of(const Sheet& sheet, int side) {
  const SideCurve& curve = sheet.cloth_sides[static_cast<std::size_t>(side)];
  return curve.closest(curve.point(0.5 * curve.length())).normal;
}

// Whether a name tells of the left, or of the right.
bool names_side(const std::string& name, bool left) {
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t end = std::min(name.find_first_of("_ ", i), name.size());
    const std::string word = name.substr(i, end - i);
    if (word == (left ? "left" : "right") || word == (left ? "l" : "r")) return true;
    i = end + 1;
  }
  return false;
}

std::string amount_words(const TicketOperation& o) {
  constexpr double kAlike = 0.85;  // of the largest: plies that keep to this are spoken of as one
  const bool alike = std::all_of(o.sides.begin(), o.sides.end(),
                                 [&](const TicketSide& side) { return side.amount >= kAlike * o.per_ply; });
  std::string text = (alike ? " " : " up to ") + millimetres(o.per_ply);
  if (o.total > 1.001 * o.per_ply) text += " per ply (" + millimetres(o.total) + " in all)";
  return text;
}

// "all along"; "at the waist, easing to 10 mm at the hem"; "at the top, tapering to nothing 160 mm away".
std::string course_words(const TicketOperation& o) {
  std::string text = o.largest_at.empty() ? "" : " " + o.largest_at;
  if (o.taper_length > 0.0) {
    text += ", tapering to nothing";
    if (o.tapers_to != o.largest_at) text += " " + o.tapers_to + ",";
    return text + " " + millimetres(o.taper_length) + " away";
  }
  if (o.least_at.empty()) return text;
  text += ", easing to " + millimetres(o.least);
  return o.least_at == o.largest_at ? text : text + " " + o.least_at;
}

std::string cut_anew_words(const TicketOperation& o) {
  std::string text = o.fabric == FabricNeed::NeedsFabric
                         ? " from new cloth; what is there cannot be pieced"
                         : " out of the cloth that is there; unpick all round and lay the new pattern on";
  for (std::size_t i = 0; i < o.touches.size(); ++i)
    text += (i > 0 ? " and " : "; take off and set again: ") + o.touches[i];
  return text + ".";
}

}  // namespace

std::vector<std::string> side_names(const Pattern& pattern, const Sheet& sheet, int side) {
  const PanelSide& s = sheet.sides[static_cast<std::size_t>(side)];
  const Panel& panel = pattern.panels[static_cast<std::size_t>(sheet.panel)];
  std::vector<std::string> names;
  for (const int edge : s.edges)
    if (const std::string& name = panel.edges[static_cast<std::size_t>(edge)].name; !name.empty())
      names.push_back(readable(name));
  // A side that runs on over the middle has neither.
  const auto same = [&](const std::string& name) { return without_left_right(name) == without_left_right(names[0]); };
  if (names.size() > 1 && names.front() != names.back() && std::all_of(names.begin(), names.end(), same))
    return {without_left_right(names[0])};
  if (!names.empty()) return names;
  const Panel* other = partner_panel(pattern, sheet.panel, s);
  if (other == &panel) return {"dart of " + panel_words(panel)};
  if (other) {
    std::string a = panel_words(panel), b = panel_words(*other);
    if (without_left_right(a) == without_left_right(b)) return {"centre seam of " + without_left_right(a)};
    if (b < a) std::swap(a, b);
    return {"seam of " + a + " and " + b};
  }
  return {free_side_words(outward_of(sheet, side)) + " of " + panel_words(panel)};
}

std::string edge_words(const Pattern& pattern, const Sheet& sheet, int side) {
  const PanelSide& s = sheet.sides[static_cast<std::size_t>(side)];
  const Panel& panel = pattern.panels[static_cast<std::size_t>(sheet.panel)];
  for (const int edge : s.edges)
    if (const std::string& name = panel.edges[static_cast<std::size_t>(edge)].name; !name.empty())
      return without_left_right(name);
  return s.sewn ? std::string() : free_side_words(outward_of(sheet, side));
}

std::string panel_words(const Panel& panel) {
  return readable(panel.piece_label.empty() ? panel.name : panel.piece_label);
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

std::string spoken_list(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // mirror images by what they share
  for (const std::string& name : names) {
    const std::string key = without_left_right(name);
    auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.first == key; });
    if (found == groups.end()) found = groups.insert(groups.end(), {key, {}});
    if (std::find(found->second.begin(), found->second.end(), name) == found->second.end())
      found->second.push_back(name);
  }
  std::vector<std::string> words;
  for (const auto& [key, members] : groups) {
    const bool both =
        std::any_of(members.begin(), members.end(), [](const auto& name) { return names_side(name, true); }) &&
        std::any_of(members.begin(), members.end(), [](const auto& name) { return names_side(name, false); });
    if (!both || members.size() < 2)
      words.insert(words.end(), members.begin(), members.end());
    else if (members[0].starts_with("left ") || members[0].starts_with("right "))
      words.push_back("left and right " + key);
    else
      words.push_back(key + ", left and right");
  }
  const bool nested = std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word.find(" and ") != std::string::npos || word.find(", ") != std::string::npos;
  });
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : nested ? "; " : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
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
  text += ": " + std::string(operation_words(o.kind));
  if (o.kind == OperationKind::CutAnew) return text + cut_anew_words(o);
  text += amount_words(o) + course_words(o);
  if (o.fabric == FabricNeed::WithinAllowance)
    text += "; the seam allowance gives it, " + millimetres(o.allowance.left) + " of it are left";
  if (o.fabric == FabricNeed::NeedsFabric) text += "; needs new cloth";
  if (o.with_step > 0)
    text += (o.fabric == FabricNeed::NeedsFabric ? ", in one piece with step " : ", together with step ") +
            std::to_string(o.with_step);
  if (o.below_accuracy) text += "; less than a body can be measured to";
  return text + ".";
}

}  // namespace toile
