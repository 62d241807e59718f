// SPDX-License-Identifier: GPL-3.0-or-later
// True the seams of the altered pieces, as patternmakers do: both sides of every seam get the lengths that the wanted
// pattern eases onto each other.
//   kept cloth with kept cloth: both move to the middle between them
//   new cloth with kept cloth: the new cloth gives way, which may stay a little strained and is then shorter than its
//   place in the wanted panel; as a whole it takes the mean warp and weft strain of the cloth it is sewn to
// What differs by more than a sixth, with new cloth by more than a quarter, stays as it is, to be eased. Used by
// sew_altered only.   Lengths in metres.
#pragma once

#include <list>

#include "engine/alter/chain_seams.h"
#include "engine/alter/sewn_pattern.h"

namespace toile {

// A piece as it was trued for lengths of its chains, or could not be.
struct KnownTruing {
  PieceBorder border;
  Points2 rest, target;  // of its map
  Vec2 scale = Vec2::Ones();
  bool is_new = false;
  std::vector<std::pair<std::vector<int>, double>> wanted;  // vertices of a chain, and its length
  bool given = false;
  PieceBorder border_after;
  Points2 rest_after;
};

// Changes `rest` of borders and maps. `fixed`: per piece, cannot change. Returns, per piece, whether it stayed as it
// was although other lengths were wanted of it: its outline would have crossed itself. `known`: looked up and added to.
std::vector<bool> true_seams(const std::vector<BorderChain>& chains, const std::vector<ChainSeam>& seams,
                             const std::vector<bool>& fixed, double edge_length, std::vector<PieceBorder>& borders,
                             std::vector<SewnPiece>& pieces, std::list<KnownTruing>* known = nullptr);

}  // namespace toile
