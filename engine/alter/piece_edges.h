// SPDX-License-Identifier: GPL-3.0-or-later
// Draw the border chains of a piece as edges of a panel. Used by sew_altered only.   Lengths in metres.
#pragma once

#include "engine/alter/sewn_borders.h"

namespace toile {

struct PieceEdges {
  std::vector<Vec2> corners;      // corner k starts chain k
  std::vector<EdgeCurve> curves;  // of chain k, counter-clockwise
  std::vector<double> lengths;    // of chain k before a curve was drawn through it
  std::vector<int> of_edge;       // edge of the original panel on whose curve it lies, or -1
  bool sound = true;              // the outline encloses cloth and keeps clear of itself, no edge is without length
};

// `chains`: those of the piece, in order. `original`: the panel it was cut from, or null for new cloth.
PieceEdges draw_piece_edges(const PieceBorder& piece, const std::vector<const BorderChain*>& chains,
                            const Panel* original);

}  // namespace toile
