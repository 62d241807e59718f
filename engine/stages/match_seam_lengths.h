// SPDX-License-Identifier: GPL-3.0-or-later
// The least change of corners and curves after which sewn sides have wanted length ratios again.
//
// Unknowns: corners, control points and radii of all panels; constraint per seam: length_a - ratio * length_b = 0.
// Newton on the constraints with the step of least norm. Lengths in metres.
#pragma once

#include <vector>

#include "engine/stages/side_rules.h"

namespace toile {

// `ratios[s]` is the wanted length of side a over side b of seam s. Sides that `rules` locks are not moved. Returns the
// largest remaining mismatch |length_a - ratio * length_b|.
double match_seam_lengths(Pattern& pattern, const std::vector<double>& ratios, const SideRules& rules);

}  // namespace toile
