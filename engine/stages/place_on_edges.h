// SPDX-License-Identifier: GPL-3.0-or-later
// Move the vertices along a panel's edges onto its drawn edges.  Metres.
#pragma once

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

// `rest` (#V x 2) with the vertices along every edge on that edge of `drawn`, which was drawn from `rest`
// (fit_pattern_edges). They keep their shares of the edge's length; sewn vertices stand at equal shares of both sides.
// `original` is the pattern that `mesh` was made of.
Points2 place_on_edges(const Pattern& original, const Pattern& drawn, const PatternMesh& mesh, const Points2& rest);

}  // namespace toile
