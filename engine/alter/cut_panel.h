// SPDX-License-Identifier: GPL-3.0-or-later
// One panel's alteration as its cloth shows it when both passes have torn it: what is kept, let in and taken away. Of
// plans in which a panel's cloth lies alike it is the same, and so are the panel's pieces before they are trued: each
// is cut once.   Lengths in metres.
#pragma once

#include <list>

#include "engine/alter/sewn_borders.h"
#include "engine/alter/sewn_pattern.h"

namespace toile {

// A panel's pieces before they are trued, or why they cannot be sewn.
struct PanelPieces {
  std::vector<SewnPiece> pieces;
  std::vector<PieceBorder> borders;  // one per piece
  std::string problem;
};

// Pieces as they were cut round these regions, of which the seam allowance gives some.
struct KnownPieces {
  Loops insertions, removals;  // outlines, each with its holes
  std::vector<bool> let_out;   // per insertion
  PanelPieces cut;
};

struct CutPanel {
  Sheet inserting, removing;
  PanelAlteration alteration;       // without its passes
  std::vector<Vec2> filled_target;  // outline, with its darts filled
  int dropped = 0;                  // openings too small to sew
  std::vector<KnownPieces> pieces;
};

using CutMemory = std::vector<std::list<CutPanel>>;  // per panel

// What the sheets of both passes make of panel `p`; made where `known` has none of sheets that lie so.
CutPanel& cut_panel(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, std::size_t p,
                    const Sheet& inserting, const Sheet& removing, const AlterPatternOptions& options,
                    std::list<CutPanel>& known);

}  // namespace toile
