// SPDX-License-Identifier: GPL-3.0-or-later
// Which node of a garment lies opposite each node, where body, pattern and mesh are the same on the left and the right.
// The rest state of loose cloth is not unique at the size of a triangle: with this the one found is symmetric.
#pragma once

#include "engine/sim/cloth.h"

namespace toile {

// Across x = 0.
struct NodeMirror {
  std::vector<int> image;  // #N; the image of the image is the node itself, a node on the middle is its own
  std::vector<int>
      side;  // #N; +1: of a panel worn at x > 0, another one's image; -1: of its image; 0: of both or neither
};

// Each row becomes the mean of itself and of its image's reflection: positions, moves and forces (#N x 3) alike. For a
// gradient at symmetric positions this is the gradient among symmetric positions.
void symmetrise(const NodeMirror& mirror, Points3& rows);

// Whether the cloth, evenly enlarged from the symmetric `nodes`, pulls on nodes as on their images: grain and rest
// shape of both sides are alike.
bool pulls_alike(const Cloth& cloth, const NodeMirror& mirror, const Points3& nodes);

}  // namespace toile
