// SPDX-License-Identifier: GPL-3.0-or-later
// Does the outline of a panel, with its curves, cross or touch itself?  Metres.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/pattern.h"

namespace toile {

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
