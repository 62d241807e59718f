// SPDX-License-Identifier: GPL-3.0-or-later
// How far a tear stands open along its way in the finished sheet: along a released side or along the lips of a cut.
// Used by read_operations only.   Lengths in metres.
#pragma once

#include "engine/alter/propagate_tear.h"

namespace toile {

struct TearProfile {
  std::vector<double> at;    // along the way, ascending from 0, in the cloth
  std::vector<double> open;  // >= 0
  std::vector<Vec2> middle;  // half way across the opening, in the wanted panel
  double largest = 0.0;
  std::size_t largest_index = 0;
  bool shut_at_start = false, shut_at_end = false;  // tapers to nothing there

  // Every `spacing` from the start; the last entry holds at the end.
  std::vector<double> sampled(double spacing) const;
};

TearProfile side_profile(const Sheet& sheet, int side);
TearProfile cut_profile(const Sheet& sheet, const Cut& cut);

}  // namespace toile
