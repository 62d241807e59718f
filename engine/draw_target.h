// SPDX-License-Identifier: GPL-3.0-or-later
// Draw a derived pattern so that it can be cut: no panel overlaps itself, no triangle of its mesh is inverted.
//
// The derived outline is drawn with the original's edges, the mesh placed on the drawing and its inside solved again.
// Should a panel then cross itself, shrink to nothing or a triangle stay inverted, that panel is held back: drawn from
// (1 - t) reference + t derived for the largest t that will do; where sewn sides no longer agree, all panels are.
// The reference itself, t = 0, always will.  Metres.
#pragma once

#include "engine/stages/derive_pattern.h"
#include "engine/stages/fit_pattern_edges.h"

namespace toile {

struct DrawnTarget {
  FitPatternEdgesResult drawn;
  DerivePatternResult inside;  // flat positions on the drawing
  double kept_change = 1.0;    // t of the panels that were held back; 1: none was
  std::vector<int> held_back;  // their numbers
};

// `derived`: flat positions that derive_pattern found for `shape`.
DrawnTarget draw_target(const Pattern& pattern, const PatternMesh& reference_mesh, const FittingMap& reference_fit,
                        const Drape& shape, const Points2& derived, const GarmentMirrors& mirrors,
                        const DerivePatternOptions& options, Progress* progress);

}  // namespace toile
