// SPDX-License-Identifier: GPL-3.0-or-later
// Draw an altered pattern: the pieces of the sewn pattern as draw_pattern draws them, and what they come from.
//
// A kept panel shows its outline before and what is taken away in red; where it is cut apart, a guide shows the parts
// in their place. Where cloth is let in, a guide shows the panel as it will be sewn, insertions in blue; every
// insertion is a piece of its own. Kept cloth turns in one allowance where it is cut open, so that cut line and stitch
// line lie one allowance apart on every piece.  Millimetres.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/core/drawing.h"

namespace toile {

Drawing draw_alteration(const Pattern& pattern, const AlterPatternResult& alteration);

std::vector<Vec2> in_mm(const std::vector<Vec2>& metres);

}  // namespace toile
