// SPDX-License-Identifier: GPL-3.0-or-later
// Does a closed polygon cross or touch itself?
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/core/types.h"

namespace toile {

// `polygon` is closed, its first point not repeated. Segment i runs from point i to point i + 1. Returns the first pair
// of segments, i < j, that share a point they should not: a crossing, a touch within `tolerance` (same unit as the
// points) of segments that are not neighbours, or neighbours that run back over each other. Empty for a simple polygon.
std::optional<std::pair<int, int>> find_self_crossing(const std::vector<Vec2>& polygon, double tolerance);

}  // namespace toile
