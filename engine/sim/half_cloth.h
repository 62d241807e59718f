// SPDX-License-Identifier: GPL-3.0-or-later
// One half of a garment that is the same on both sides of x = 0: as long as it stays so, the half is all that moves.
// Its energy is half that of the garment, term by term: of two that are images of each other one, half of one that is
// its own image. Forces on nodes off the middle are those of the garment.
#pragma once

#include <optional>

#include "engine/sim/friction_state.h"
#include "engine/sim/node_mirror.h"

namespace toile {

struct HalfCloth {
  Cloth cloth;                   // #H nodes
  std::vector<int> node, image;  // #H: of the garment; a node on the middle is its own image
  std::vector<int> row;          // #N: which node of the half it is or is the image of
  std::vector<int> side;         // #N: 1 of the half, -1 of the other one, 0 on the middle

  // Positions, moves and directions of the half (#H x 3) from those of the garment (#N x 3), and back.
  Points3 folded(const Points3& whole) const;
  Points3 unfolded(const Points3& rows) const;
  void unfold(const Points3& rows, Points3& whole) const;
  // Adds the gradient by nodes of the garment, #N x 3, to that by nodes of the half.
  void add_folded(const Points3& gradient, Points3& rows) const;
  FrictionState folded(const FrictionState& whole) const;
  FrictionState unfolded(const FrictionState& rows) const;

  // What a node of the garment is tied by, for its node of the half; nothing on the other side.
  template <class Tie>
  std::vector<Tie> folded(const std::vector<Tie>& ties) const {
    std::vector<Tie> kept;
    for (Tie tie : ties) {
      const int on = side[static_cast<std::size_t>(tie.node)];
      if (on < 0) continue;
      tie.node = row[static_cast<std::size_t>(tie.node)];
      if (on == 0) tie.stiffness *= 0.5;
      kept.push_back(tie);
    }
    return kept;
  }
};

// `start` (#N x 3): which half is the left one, where both could be. Empty where a triangle reaches from one side to
// the other: there is no cut along x = 0 then.
std::optional<HalfCloth> half_of(const Cloth& cloth, const NodeMirror& mirror, const Points3& start);

}  // namespace toile
