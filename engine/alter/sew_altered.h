// SPDX-License-Identifier: GPL-3.0-or-later
// Put the altered garment together as a pattern: kept pieces as they are cut from the original cloth, insertions true
// to scale, new seams where they meet, original seams parted where pieces meet on either ply.
//
// A piece's edge that lies on an edge of the original panel is a part of that edge's own curve; others are lines,
// Bézier curves or polylines through their points. Seam allowances, hems, locks and labels follow the edges, notches
// and grainlines the cloth; new seams get a notch in their middle. A panel whose alteration cannot be sewn (pieces that
// overlap, cloth that turns over) is cut anew to the target.   Lengths in metres.
#pragma once

#include "engine/alter/altered_pieces.h"

namespace toile {

// Requires result.panels and result.ticket of the same two passes. Panels that turn out not to be sewable as altered
// are added to `recut`: then operations and pieces do not agree any more, and both are to be made again. `cuts`: one
// per panel.
SewnPattern sew_altered(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                        const std::vector<CutPanel*>& cuts, const AlterPatternResult& result, RecutPanels& recut,
                        SewMemory& memory);

// Gives the ticket's pieces the sizes they have in the sewn pattern, and says what else the person who sews must know.
void tell_ticket(const SewnPattern& sewn, Ticket& ticket);

}  // namespace toile
