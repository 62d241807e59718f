// SPDX-License-Identifier: GPL-3.0-or-later
// Split a plane polygon where it bends back on itself, so that an L or a T becomes strips.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

struct SplitPolygonOptions {
  double least_turn = 0.9;   // rad: reflex corners that turn less are left, so that curves stay whole
  double reach = 0.008;      // m: over which the direction on either side of a corner is taken
  double least_area = 2e-4;  // m^2: no part smaller than this is split off
};

// Each reflex corner is cut along the shorter continuation of its two edges. `outline` counter-clockwise and simple;
// the parts are so too and together have its area.
std::vector<std::vector<Vec2>> split_at_reflex_corners(const std::vector<Vec2>& outline,
                                                       const SplitPolygonOptions& options = {});

}  // namespace toile
