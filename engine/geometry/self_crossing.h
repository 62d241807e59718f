// SPDX-License-Identifier: GPL-3.0-or-later
// Does a closed polygon cross or touch itself?
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/types.h"

namespace toile {

// `polygon` is closed, its first point not repeated. Segment i runs from point i to point i + 1. Returns a pair of
// segments, i < j, that share a point they should not: a crossing, a touch within `tolerance` (same unit as the
// points) of segments that are not neighbours, or neighbours that run back over each other. Of several, the first that
// a sweep along the longer side of the bounding box meets. Empty for a simple polygon.
// `comparisons_left`, where given, bounds the work, which grows with the square of the number of segments that overlap
// along the sweep: it is lowered by the comparisons made, and once it is below zero the search ends without an answer.
std::optional<std::pair<int, int>> find_self_crossing(const std::vector<Vec2>& polygon, double tolerance,
                                                      std::int64_t* comparisons_left = nullptr);

}  // namespace toile
