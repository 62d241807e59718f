// SPDX-License-Identifier: GPL-3.0-or-later
// Cut new cloth to the lengths it is sewn to: kept cloth that stays a little strained is shorter than its place in the
// wanted panel, and what is let in beside it true to that place would have to be eased.
//
// Unknown: the flat position of every point of a new piece.  Minimise
//   sum_f A_f |C_f - I|^2 / 4  +  w sum_e (|e| - l_e)^2 / l_e
// with C_f the metric of the map from the wanted panel, less the warp and weft strain the kept cloth beside it has in
// the mean, and e the border edges of chains that are sewn to kept cloth or to other new cloth; Gauss-Newton. Used by
// sew_altered only.   Lengths in metres.
#pragma once

#include "engine/alter/chain_seams.h"

namespace toile {

// Changes `rest` of borders and maps of insertions and of panels that are cut anew from new cloth.
void fit_new_cloth(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams, double edge_length,
                   std::vector<PieceBorder>& borders, std::vector<SewnPiece>& pieces);

}  // namespace toile
