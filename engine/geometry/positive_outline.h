// SPDX-License-Identifier: GPL-3.0-or-later
// The outer outline of a closed curve that may cross itself.
#pragma once

#include "engine/core/types.h"

namespace toile {

// The longest-reaching (largest area) boundary of the region that `curve` winds round in the positive sense at least
// once, counter-clockwise. A simple counter-clockwise curve comes back unchanged. Crossings are resolved in double
// precision: parts closer than 1e-6 of the curve's extent are taken as touching. If no closed boundary can be chained,
// the curve comes back as it is.
std::vector<Vec2> positive_outline(const std::vector<Vec2>& curve);

}  // namespace toile
