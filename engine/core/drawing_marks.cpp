// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/drawing_marks.h"

#include <algorithm>

namespace toile {

std::vector<Vec2> notch_outline(const DrawingNotch& notch) {
  const Vec2 along(-notch.inward.y(), notch.inward.x());
  const auto at = [&](double across, double depth) -> Vec2 {
    return notch.at + across * notch.width * along + depth * notch.depth * notch.inward;
  };
  switch (notch.type) {
    case NotchType::V: return {at(-0.5, 0), at(0, 1), at(0.5, 0)};
    case NotchType::T: return {at(0, 0), at(0, 1), at(-0.5, 1), at(0.5, 1)};
    case NotchType::Castle: return {at(-0.5, 0), at(-0.5, 1), at(0.5, 1), at(0.5, 0)};
    case NotchType::Check: return {at(-0.5, 0), at(0, 1), at(0, 0)};
    case NotchType::U: return {at(-0.5, 0), at(-0.5, 0.6), at(-0.25, 0.95), at(0.25, 0.95), at(0.5, 0.6), at(0.5, 0)};
  }
  return {};
}

std::vector<std::vector<Vec2>> grainline_strokes(const DrawingLine& line) {
  if (line.points.size() < 2) return {};
  const Vec2 from = line.points.front(), to = line.points.back();
  const double length = (to - from).norm();
  if (length <= 0) return {};
  const double head = std::min(8.0, 0.2 * length);
  const Vec2 along = head * (to - from) / length, across = 0.4 * Vec2(-along.y(), along.x());
  return {
      {from, to}, {to - along + across, to, to - along - across}, {from + along + across, from, from + along - across}};
}

}  // namespace toile
