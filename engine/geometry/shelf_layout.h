// SPDX-License-Identifier: GPL-3.0-or-later
// Rectangles side by side without overlap.
#pragma once

#include "engine/core/types.h"

namespace toile {

struct ShelfLayout {
  std::vector<Vec2> corners;  // lower left corner of each rectangle, in the order given; y up
  Vec2 size = Vec2::Zero();   // of all together, from (0, 0)
};

// Shelves from the top, tallest rectangles first, each as wide as `width` at most (a wider rectangle has a shelf of its
// own); `gap` between rectangles. Equal heights keep their order.
ShelfLayout lay_on_shelves(const std::vector<Vec2>& sizes, double width, double gap);

// A width that makes the whole about `aspect` times as wide as tall.
double shelf_width(const std::vector<Vec2>& sizes, double gap, double aspect);

}  // namespace toile
