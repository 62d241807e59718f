// SPDX-License-Identifier: GPL-3.0-or-later
// Draw a pattern: stitch lines, cut lines (stitch line plus seam allowance: mitred corners, none on folds, a hem's
// depth at hems), notches, grainlines, labels and seam numbers (the two sides of seam 7 both say 7). Millimetres.
#pragma once

#include "engine/core/drawing.h"
#include "engine/core/pattern.h"

namespace toile {

struct DrawPatternOptions {
  bool seam_allowance = true;    // draw the cut line; without it the stitch line stands alone
  bool seam_numbers = true;      // at the middle of every sewn edge
  double folded_dart_mm = 50.0;  // a dart with a narrower mouth is folded, not cut: the cut line runs across it, >= 0
  double tolerance_mm = 0.02;    // of curves, > 0
};

// One piece per panel, in order. Requires a pattern as import_pattern ensures.
Drawing draw_pattern(const Pattern& pattern, const DrawPatternOptions& options = {});

// The panels of `changed` with the outline of the panel of the same name in `original` beneath, and the largest
// distance between the two written on each piece ("+12.0 mm": outside the original; "-": inside).
Drawing draw_changes(const Pattern& original, const Pattern& changed);

// The allowance of an edge, m: none on a fold, the depth of its hem, its own, or the pattern's.
double seam_allowance_of(const Pattern& pattern, const PanelEdge& edge);

}  // namespace toile
