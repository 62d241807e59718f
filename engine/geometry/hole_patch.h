// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles over one hole while they are refined: loop vertices first, new ones behind them.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "engine/core/types.h"

namespace toile {

struct HolePatch {
  std::vector<Vec3> points;                // loop_size of the loop, then new ones
  std::vector<double> spacing;             // wanted edge length at every point
  std::vector<Eigen::Vector3i> triangles;  // oriented along the loop
  int loop_size = 0;
  std::function<bool(int, int)> joined;  // as in HoleLoop, for loop points
};

// Splits triangles whose centre is farther from their corners than the wanted edge length, and flips edges until the
// patch is Delaunay in the small; the spacing of new points is the mean of the corners' [Liepa2003, Sec. 4].
void refine_patch(HolePatch& patch, int max_points);

}  // namespace toile
