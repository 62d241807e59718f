// SPDX-License-Identifier: GPL-3.0-or-later
// Which labels of a picture can be read: none may lie over another one.
#pragma once

#include <string>
#include <vector>

#include "engine/core/types.h"

namespace toile {

struct Label {
  Vec2 at;  // middle of the baseline, pixels, y down
  double height = 0.0;
  std::string text;
  double angle = 0.0;  // of the baseline, rad, counter-clockwise as seen
};

// One per label: whether there is room for it. Of two that overlap the longer text stays, a name rather than a number;
// of equals the earlier one.
std::vector<bool> labels_with_room(const std::vector<Label>& labels);

}  // namespace toile
