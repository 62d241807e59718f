// SPDX-License-Identifier: GPL-3.0-or-later
// Does the outline of a panel, with its curves, cross or touch itself?  Metres.
#pragma once

#include <optional>

#include "engine/core/pattern.h"

namespace toile {

struct OutlineCrossing {
  int first_edge = 0, second_edge = 0;
  Vec2 place = Vec2::Zero();  // near by
};

std::optional<OutlineCrossing> find_outline_crossing(const Panel& panel);

}  // namespace toile
