// SPDX-License-Identifier: GPL-3.0-or-later
// The control cage that all mannequins share: which points there are, row by row, and which quads join them.
//
// Only the left half and the midline (x = 0) are listed; the right half is the mirror image. Rows of the trunk and the
// head run from the front (0) over the wearer's left (4) to the back (8), rows of the limbs close around the limb.
#pragma once

#include <array>

#include "engine/core/body.h"
#include "engine/geometry/catmull_clark.h"

namespace toile {

template <int Columns>
using CageRow = std::array<int, Columns>;  // point numbers

struct MannequinCage {
  static constexpr int kAround = 9;      // front to back over the left side
  static constexpr int kLegAround = 10;  // the trunk's nine and the bridge between the legs
  static constexpr int kArmAround = 10;  // armhole: bottom front, bottom, bottom back, ..., front low

  std::array<CageRow<kAround>, 9> trunk;     // from just above the crotch to the armpit
  std::array<CageRow<kAround>, 5> shoulder;  // beside the armhole (rows 0, 1: none at the side), over it, neck base
  CageRow<kAround> neck;
  std::array<CageRow<kAround>, 9> head;     // from under the jaw to above the forehead
  std::array<std::array<int, 2>, 3> crown;  // front, middle, back: on the midline and left of it
  int bridge = 0;                           // the crotch
  std::array<CageRow<kLegAround>, 10> leg;
  std::array<CageRow<kLegAround>, 8> foot;
  std::array<int, 2> toe;
  std::array<CageRow<kArmAround>, 8> arm;   // from the deltoid to the wrist
  std::array<CageRow<kArmAround>, 4> hand;  // columns 9, 0, 1, 2, 3 on the palm, from the thumb's side; 8 ... 4 behind
  std::array<std::array<CageRow<4>, 3>, 4> finger;  // from the index: out of the quads between palm and back
  std::array<CageRow<4>, 3> thumb;

  int half_count = 0;          // points listed above
  std::vector<int> midline;    // those at x = 0, rising
  std::vector<int> mirror_of;  // per point of the whole cage: its mirror image (itself on the midline)
  Quads quads;                 // of the whole cage, outward

  int point_count() const { return static_cast<int>(mirror_of.size()); }
  CageRow<kLegAround> leg_loop() const;  // where the left leg begins on the trunk
  CageRow<kArmAround> armhole() const;   // where the left arm begins
};

MannequinCage make_mannequin_cage();

// The cage's surface: refined twice, put on the limit surface and cut into triangles. Made once, then shared.
struct MannequinTemplate {
  MannequinCage cage;
  PointStencils limit;    // cage points -> where they come to lie
  PointStencils surface;  // cage points -> vertices; the first rows are the cage points
  Triangles triangles;
  std::vector<int> mirror_of;  // per vertex
  std::vector<bool> left;      // per vertex: on the wearer's left
  Triangles left_arm;          // those of the triangles that make up the left arm and hand

  int vertex_count() const { return static_cast<int>(surface.rows()); }
};

const MannequinTemplate& mannequin_template();

}  // namespace toile
