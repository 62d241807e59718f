// SPDX-License-Identifier: GPL-3.0-or-later
// The altered garment as a pattern that can be cut, sewn, draped and altered again. Lengths in metres.
#pragma once

#include "engine/core/pattern.h"

namespace toile {

// Cloth of a piece as a mesh: where every point of it lies flat in the piece, and where in the wanted panel.
struct PieceMap {
  Points2 rest, target;
  Triangles triangles;
  int border_count = 0;  // the first vertices are its border, counter-clockwise
};

struct SewnPiece {
  int panel = 0;           // of the original pattern
  int insertion = -1;      // number in PanelAlteration::insertions; -1: kept cloth
  bool recut = false;      // the whole panel cut anew to the target ...
  bool own_cloth = false;  // ... out of the original panel's cloth, where `rest` has it
  double strain = 0.0;     // area-weighted p98 of the largest stretch of kept cloth against the original, dimensionless
  double turned_over = 0.0;  // share of its area that the map turns over; 0 for cloth that can be sewn
  PieceMap map;
};

// What a seam of the sewn pattern is to join, before curves are drawn through it.
struct SewnSeam {
  bool added = false;  // made by the alteration; else a part of an original seam
  double length_a = 0.0, length_b = 0.0;
  double eased = 0.0;  // m, by which the wanted pattern has a longer than b there; 0 for seams that were added
};

struct SewnPattern {
  Pattern pattern;
  std::vector<SewnPiece> pieces;   // one per panel of `pattern`
  std::vector<SewnSeam> seams;     // one per seam of `pattern`
  std::vector<std::string> flags;  // panels that could not be sewn as altered, with the reason; unlike_seams
};

// The most by which the two sides of a seam, as they are drawn, differ from what is eased there, m.
double seam_mismatch(const SewnPattern& sewn);
// Seams whose sides differ by so much that whoever sews them has to know, in words.
std::vector<std::string> unlike_seams(const SewnPattern& sewn);

}  // namespace toile
