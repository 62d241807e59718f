// SPDX-License-Identifier: GPL-3.0-or-later
// Where one polygon fits into another when it may be moved but not turned, or only by half a turn.
// Grid over all shifts that its bounding box allows, then a compass search for the roomiest place.   Lengths in metres.
#pragma once

#include <optional>

#include "engine/core/types.h"

namespace toile {

struct PolygonPlace {
  Vec2 shift = Vec2::Zero();
  bool turned = false;     // by half a turn about the origin, before it is shifted
  double clearance = 0.0;  // least distance between the outlines, >= 0

  Vec2 operator()(const Vec2& p) const { return (turned ? Vec2(-p) : p) + shift; }
};

// The roomiest place of `inner` inside `outer` (both simple) with at least `clearance` all round, to about a
// millimetre; nothing where none was found, though very tight ones can be missed.
std::optional<PolygonPlace> place_inside(const std::vector<Vec2>& outer, const std::vector<Vec2>& inner, bool turned,
                                         double clearance = 0.0);

}  // namespace toile
