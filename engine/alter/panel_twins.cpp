// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/panel_twins.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/fit_reflection.h"

namespace toile {
namespace {

constexpr double kLength = 0.002, kLengthShare = 0.01;  // m and relative, of sides
constexpr double kCorner = 0.01;                        // m, of corners after reflection
constexpr double kOpposite = 0.03;                      // m, between centres after reflection

Vec2 side_start(const Sheet& sheet, std::size_t side) {
  return sheet.cloth_sides[side].points().front();
}

Vec2 side_middle(const Sheet& sheet, std::size_t side) {
  return sheet.cloth_sides[side].point(0.5 * sheet.cloth_sides[side].length());
}

// The reflection that takes side i of `from` onto side (shift - i) of `to`, if it fits.
std::optional<PanelTwin> fit(const Sheet& from, const Sheet& to, std::size_t shift) {
  const std::size_t count = from.sides.size();
  PanelTwin twin;
  std::vector<std::pair<Vec2, Vec2>> pairs;
  Vec2 from_centre = Vec2::Zero(), to_centre = Vec2::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t image = (shift + count - i) % count;
    const double a = from.cloth_sides[i].length(), b = to.cloth_sides[image].length();
    if (std::abs(a - b) > kLength + kLengthShare * std::max(a, b)) return std::nullopt;
    twin.side_of.push_back(static_cast<int>(image));
    pairs.emplace_back(side_start(from, i), to.cloth_sides[image].points().back());
    pairs.emplace_back(side_middle(from, i), side_middle(to, image));
  }
  for (const auto& [p, q] : pairs) {
    from_centre += p / static_cast<double>(pairs.size());
    to_centre += q / static_cast<double>(pairs.size());
  }
  const auto reflection = fit_reflection(pairs, from_centre, to_centre);
  if (!reflection) return std::nullopt;
  twin.reflection = *reflection;
  for (const auto& [p, q] : pairs)
    if ((twin.reflection * (p - from_centre) - (q - to_centre)).norm() > kCorner) return std::nullopt;
  return twin;
}

Vec3 placed_centre(const Panel& panel) {
  Vec2 centre = Vec2::Zero();
  for (const Vec2& corner : panel.corners) centre += corner / static_cast<double>(panel.corners.size());
  return panel.rotation * Vec3(centre.x(), centre.y(), 0) + panel.translation;
}

Vec3 mirrored(const Pattern& pattern, const Vec3& point) {
  Vec3 normal = Vec3::UnitX();
  double offset = 0.0;
  if (pattern.symmetry == Pattern::Symmetry::Plane) {
    normal = Vec3(pattern.symmetry_plane[0], pattern.symmetry_plane[1], pattern.symmetry_plane[2]);
    offset = pattern.symmetry_plane[3] / normal.norm();
    normal.normalize();
  }
  return point - 2.0 * (normal.dot(point) - offset) * normal;
}

// Panels that must be treated differently choose for themselves.
bool treated_alike(const Panel& a, const Panel& b) {
  return a.locked == b.locked && (&a == &b || (a.keep_outs.empty() && b.keep_outs.empty()));
}

std::optional<PanelTwin> best_fit(const Sheet& from, const Sheet& to) {
  std::optional<PanelTwin> best;
  if (from.sides.size() != to.sides.size()) return best;
  for (std::size_t shift = 0; shift < from.sides.size(); ++shift) {
    auto found = fit(from, to, shift);
    // reflection(0, 0) is -1 for x -> -x, the usual way that left and right are drawn.
    if (found && (!best || found->reflection(0, 0) < best->reflection(0, 0) - 1e-9)) best = std::move(found);
  }
  return best;
}

}  // namespace

std::vector<std::optional<PanelTwin>> find_panel_twins(const Pattern& pattern, const std::vector<Sheet>& sheets) {
  std::vector<std::optional<PanelTwin>> twins(sheets.size());
  std::vector<Vec3> centres;
  for (const Panel& panel : pattern.panels) centres.push_back(placed_centre(panel));
  for (std::size_t p = 0; p < sheets.size(); ++p) {
    std::vector<std::pair<double, std::size_t>> opposite;
    for (std::size_t q = 0; q < sheets.size(); ++q) {
      const double off = (mirrored(pattern, centres[p]) - centres[q]).norm();
      if (off < kOpposite && (!twins[q] || q == p) && treated_alike(pattern.panels[p], pattern.panels[q]))
        opposite.emplace_back(off, q);
    }
    std::sort(opposite.begin(), opposite.end());
    for (const auto& [off, q] : opposite) {
      if (twins[p]) break;
      twins[p] = best_fit(sheets[p], sheets[q]);
      if (!twins[p]) continue;
      twins[p]->panel = static_cast<int>(q);
      if (q == p) break;
      PanelTwin back = *twins[p];
      back.panel = static_cast<int>(p);
      for (std::size_t i = 0; i < back.side_of.size(); ++i)
        back.side_of[static_cast<std::size_t>(twins[p]->side_of[i])] = static_cast<int>(i);
      back.reflection = twins[p]->reflection.transpose();
      twins[q] = back;
    }
  }
  return twins;
}

}  // namespace toile
