// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/drawing.h"

#include <limits>
#include <string_view>

namespace toile {

std::string_view line_kind_name(LineKind kind) {
  static constexpr std::array<std::string_view, kLineKindCount> kNames = {
      "cut", "stitch", "fold", "internal", "grainline", "insertion", "removal", "original"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::array<Vec2, 2> bounds(const DrawingPiece& piece) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Vec2 low(kFar, kFar), high(-kFar, -kFar);
  const auto add = [&](const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); };
  for (const DrawingLine& line : piece.lines)
    for (const Vec2& p : line.points) add(p);
  for (const DrawingNotch& notch : piece.notches) add(notch.at), add(notch.at + notch.depth * notch.inward);
  for (const DrawingText& text : piece.texts) add(text.at);
  if (low.x() > high.x()) return {Vec2::Zero(), Vec2::Zero()};
  return {low, high};
}

}  // namespace toile
