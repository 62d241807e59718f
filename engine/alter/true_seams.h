// SPDX-License-Identifier: GPL-3.0-or-later
// True the seams of the altered pieces, as patternmakers do: both sides of every seam get the lengths that the wanted
// pattern eases onto each other.
//   kept cloth with kept cloth: both move to the middle between them
//   new cloth with kept cloth: the new cloth gives way, which may stay a little strained and is then shorter than its
//   place in the wanted panel; as a whole it takes the mean warp and weft strain of the cloth it is sewn to
// What differs by more than a sixth, with new cloth by more than a quarter, stays as it is, to be eased. Used by
// sew_altered only.   Lengths in metres.
#pragma once

#include "engine/alter/chain_seams.h"
#include "engine/alter/sewn_pattern.h"

namespace toile {

// Changes `rest` of borders and maps. `fixed`: per piece, cannot change. Returns, per piece, whether it stayed as it
// was although other lengths were wanted of it: its outline would have crossed itself.
std::vector<bool> true_seams(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams,
                             const std::vector<bool>& fixed, double edge_length, std::vector<PieceBorder>& borders,
                             std::vector<SewnPiece>& pieces);

}  // namespace toile
