// SPDX-License-Identifier: GPL-3.0-or-later
// Tears chosen round by round, one per panel: the paper's way (weights from the border's stress, a program over what is
// possible now) and the greedy one, for comparison with choosing all of them together.
// Source: [Eggler2024, Sec. 6.2, Algorithm 1].  Lengths in metres.
#pragma once

#include "engine/alter/tear_pattern.h"

namespace toile {

// Stretches, tears and reverts what proves redundant. `sheets`: of every panel on `mesh`, as the plain map lays them.
TornPattern tear_in_rounds(const Pattern& pattern, const PatternMesh& mesh, std::vector<Sheet> sheets,
                           const TearPatternOptions& options, Progress* progress = nullptr);

}  // namespace toile
