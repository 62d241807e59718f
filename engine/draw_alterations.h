// SPDX-License-Identifier: GPL-3.0-or-later
// Draw what happens to the cloth: every panel as it is, with what is taken away (red) and where it is cut open to let
// cloth in (blue), and every piece of cloth to insert as a piece of its own. Millimetres.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/core/drawing.h"

namespace toile {

// Pieces: the panels of `pattern` in order, then the insertions panel by panel.
Drawing draw_alterations(const Pattern& pattern, const AlterPatternResult& altered);

}  // namespace toile
