// SPDX-License-Identifier: GPL-3.0-or-later
// One piece of an altered garment as a panel: its outline, and what its edges and its cloth take over from the original
// panel. Used by sew_altered only.   Lengths in metres.
#pragma once

#include "engine/alter/altered_pieces.h"

namespace toile {

// Piece i. Edges have the allowances, hems and locks of the line they lie on, the panel label, grainline and keep-out
// regions of its cloth; it stands where its panel stood.
Panel panel_of_piece(const Pattern& pattern, const AlterPatternResult& result, const AlteredPieces& cut, std::size_t i);

}  // namespace toile
