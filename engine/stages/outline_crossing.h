// SPDX-License-Identifier: GPL-3.0-or-later
// What a panel must be to be cut: does its outline, with its curves, cross or touch itself, and how small may it be?
// Metres.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/pattern.h"

namespace toile {

inline constexpr double kShortestEdge = 1e-5;   // m between start and end; shorter is a drawing mistake
inline constexpr double kSmallestPanel = 1e-5;  // m^2; 10 mm^2

struct OutlineCrossing {
  int first_edge = 0, second_edge = 0;
  Vec2 place = Vec2::Zero();  // near by
};

// What the test may still do, so that a file made to take long is refused at once: all curves of a pattern share so
// many chords, and so many pairs of chords are compared.
struct CrossingWork {
  int chords_per_edge = 256;
  std::int64_t comparisons_left = 5'000'000;  // below zero: used up, the last answer means nothing
};
CrossingWork crossing_work(const Pattern& pattern);

std::optional<OutlineCrossing> find_outline_crossing(const Panel& panel, CrossingWork& work);
inline std::optional<OutlineCrossing> find_outline_crossing(const Panel& panel) {
  CrossingWork work;
  return find_outline_crossing(panel, work);
}

}  // namespace toile
