// SPDX-License-Identifier: GPL-3.0-or-later
// A coarse copy of a meshed pattern, on which tears are chosen: their number and place do not need the garment's own
// resolution, and a trial costs a hundredth there. Lengths in metres.
#pragma once

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

struct CoarsePattern {
  PatternMesh mesh;     // corners and, between them, every few outline vertices of the fine mesh; sewn pairs stay pairs
  Points2 target_rest;  // #V x 2, the target pattern's flat positions of the coarse vertices
};

// About `triangles` triangles in all, at least a few dozen a panel. A mesh that has hardly more is copied.
CoarsePattern coarsen(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, int triangles);

}  // namespace toile
