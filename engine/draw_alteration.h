// SPDX-License-Identifier: GPL-3.0-or-later
// Draw an altered pattern: what to cut off the garment's panels, where to let cloth in, and the pieces to cut anew.
//
// Panels that stay as they are: as draw_pattern draws them. Altered ones: their outline before, the kept cloth with a
// seam allowance where cloth is taken away, removals in red, cuts and notches. Where cloth is let in, a guide shows
// the panel as it will be sewn, insertions in blue. Every insertion is a piece of its own: grain of its panel,
// allowance all round, twice the allowance where it meets the cut cloth, because that cloth turns in one allowance of
// its own; notches in the middle of every such seam, on the insertion and on the cut cloth.  Millimetres.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/core/drawing.h"

namespace toile {

Drawing draw_alteration(const Pattern& pattern, const AlterPatternResult& alteration);

// The cuts of every altered panel in the order they were made, each with its round and what it released of the panel's
// strain [Eggler2024, Fig. 12].
Drawing draw_tears(const Pattern& pattern, const AlterPatternResult& alteration);

}  // namespace toile
