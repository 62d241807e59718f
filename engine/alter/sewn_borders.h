// SPDX-License-Identifier: GPL-3.0-or-later
// Borders of the pieces of an altered garment as chains from corner to corner, such that both plies of every seam have
// their corners at the same places. Used by sew_altered only.   Lengths in metres.
#pragma once

#include <map>

#include "engine/alter/altered_regions.h"
#include "engine/alter/sewn_pattern.h"

namespace toile {

struct BorderVertex {
  int point = -1;  // of AlteredParts; -1 where another ply's corner was added
  Vec2 target = Vec2::Zero(), rest = Vec2::Zero();
  bool corner = false;
  bool operator==(const BorderVertex&) const = default;
};

// One piece on its way to a panel: vertices counter-clockwise, borders[i] from vertex i to the next.
struct PieceBorder {
  int panel = 0, part = 0;
  std::vector<BorderVertex> vertices;
  std::vector<RegionBorder> borders;
  bool trued = false;  // its cloth was moved off the lines it came from
  bool operator==(const PieceBorder&) const = default;
};

// A run of border between two corners with one thing on its other side.
struct BorderChain {
  int piece = 0;
  std::vector<int> vertices;  // of the piece, in order
  RegionBorder along;         // neighbour, track and places of its two ends; from, to: points or -1
};
double chain_length(const PieceBorder& piece, const BorderChain& chain);  // of its cloth

// A line that is sewn or hangs free: an edge of a panel or a lip of a cut.
struct SeamLine {
  int panel = 0;
  BorderTrack track;
  auto operator<=>(const SeamLine&) const = default;
};

// Corners along a line, ascending; entry i of one ply of a seam meets entry i of the other, counted from its end where
// they run against each other.
using LineCorners = std::map<SeamLine, std::vector<double>>;

// Adds the other ply's corners to `pieces`, then returns where they all are.
LineCorners share_corners(const Pattern& pattern, const PatternMesh& mesh, std::vector<PieceBorder>& pieces);

// Requires shared corners. What is shorter than a third of a millimetre is no chain.
std::vector<BorderChain> border_chains(const std::vector<PieceBorder>& pieces);

}  // namespace toile
