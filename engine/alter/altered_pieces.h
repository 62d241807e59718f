// SPDX-License-Identifier: GPL-3.0-or-later
// The pieces of an altered garment before they are sewn: every panel parted into kept cloth and insertions, the cloth
// of each laid out flat, its outline drawn with corners wherever a piece of another ply of its seams has one. Used by
// sew_altered only.   Lengths in metres.
#pragma once

#include "engine/alter/chain_seams.h"
#include "engine/alter/cut_anew.h"
#include "engine/alter/cut_panel.h"
#include "engine/alter/piece_edges.h"
#include "engine/alter/true_seams.h"

namespace toile {

struct DrawnPiece {
  std::vector<const BorderChain*> chains;
  PieceEdges edges;
  bool reversed = false;  // the panel's outline runs clockwise
};

struct AlteredPieces {
  std::vector<SewnPiece> pieces;     // none, where a panel cannot be cut at all
  std::vector<PieceBorder> borders;  // one per piece
  std::vector<DrawnPiece> drawn;     // one per piece; points into `chains`
  std::vector<BorderChain> chains;
  std::vector<SeamSide> edges;  // per chain: number of the piece and of its edge
  LineCorners corners;
  std::vector<ChainSeam> seams;
  std::vector<std::string> flags;

  AlteredPieces() = default;
  AlteredPieces(AlteredPieces&&) = default;
  AlteredPieces& operator=(AlteredPieces&&) = default;
};

// A piece as it was drawn.
struct KnownDrawing {
  PieceBorder border;
  bool kept = false;  // cut from the original panel
  std::vector<BorderChain> chains;
  PieceEdges edges;
};

// What is found out about pieces; another plan, or the same one where a panel is cut anew, may have them again.
struct SewMemory {
  std::list<KnownTruing> trued;
  std::list<KnownDrawing> drawn;
};

// Panels whose pieces cannot be cut or sewn are added to `recut` and come as the target has them.
AlteredPieces cut_altered_pieces(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const std::vector<CutPanel*>& cuts, const AlterPatternResult& result,
                                 RecutPanels& recut, SewMemory& memory);

}  // namespace toile
