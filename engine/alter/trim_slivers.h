// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts off slivers: places where an outline runs back along itself, less than a millimetre away. Cloth so narrow cannot
// be cut and folds over itself when it is laid out. Used by altered_regions only.   Lengths in metres.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

// Takes them off a counter-clockwise `outline` and returns them, each an outline of its own.
std::vector<std::vector<Vec2>> trim_slivers(std::vector<Vec2>& outline);

}  // namespace toile
