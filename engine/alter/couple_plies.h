// SPDX-License-Identifier: GPL-3.0-or-later
// Let both plies of every seam lie alike along it. Stretched for itself, the cloth of one panel may lie some way
// farther along a seam than the cloth of the other that it is sewn to, and what is cut from there differs in length.
// Where both plies hang on the seam, each vertex and its partner are held in the middle between where they are, and the
// panels are relaxed once more.   Source: [Eggler2024, Sec. 6] couples seams; that it is done once, after the tears, is
// this project's.  Lengths in metres.
#pragma once

#include "engine/alter/tear_memory.h"

namespace toile {

// `wanted`: where the plain map takes the mesh's vertices. Locked panels stay as they are, and hold what is sewn to
// them; so does a panel that would be strained beyond the limit. `memory`: of the pass, one per sheet, or none.
void couple_plies(const Pattern& pattern, const PatternMesh& mesh, const Points2& wanted, double stretch_limit,
                  const RelaxOptions& options, std::vector<Sheet>& sheets, TearMemory* memory = nullptr,
                  Progress* progress = nullptr);

}  // namespace toile
