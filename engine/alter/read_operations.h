// SPDX-License-Identifier: GPL-3.0-or-later
// Read tears and regions as a tailor does: what is taken in, let out, shortened, lengthened, let in as a strip, gusset
// or godet, or sewn as a dart; plies of one seam and left and right as one operation; widths before hems. Used by
// alter_pattern only.   Lengths in metres.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/alter/cut_anew.h"

namespace toile {

// Fills result.ticket.operations and the `operation` of every region. `recut`: panels that are cut anew, whatever their
// tears are.
void read_operations(const Pattern& pattern, const PatternMesh& mesh, const TornPattern& inserting,
                     const TornPattern& removing, const AlterPatternOptions& options, const RecutPanels& recut,
                     AlterPatternResult& result);

}  // namespace toile
