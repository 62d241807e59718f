// SPDX-License-Identifier: GPL-3.0-or-later
// Derivation with physics in the loop: derive a pattern, draw it with the original's edges, drape what is drawn, and
// derive again from that drape while the fit gets nearer to the reference.
//
// The first pass inverts the transported drape, which no physics has relaxed yet; each later pass inverts the drape of
// the pattern before it. The pass with the smallest rms stretch error is kept; one whose drape did not come to rest is
// followed by another, unless its layers are tangled: such a drape tells nothing. A pass that is not kept is the last.
// Source: [Eggler2024, Sec. 5.1 "Accounting for physics"]; the order of the passes was measured, see method.md
// section 4.
#pragma once

#include "engine/draw_target.h"
#include "engine/stages/compare_fits.h"
#include "engine/stages/drape_series.h"

namespace toile {

struct DeriveInLoopOptions {
  int max_passes = 3;  // derivations, each with its drape, 1..5
  // rms stretch error at which no further pass is tried, dimensionless: that of the standard preset's mesh.
  double good_enough = 0.005;
  // What a pass must have gained for another one to be tried, which gains about half as much: 0.5 mm on a metre.
  double least_gain = 0.001;
  // Share of the error before by which a pass must be nearer to be kept. Patterns that fit alike can differ by a
  // millimetre: with a tenth, meshes of different sizes keep the same pass.
  double least_nearer = 0.0;
};

struct DerivedPattern {
  FitPatternEdgesResult drawn;  // the target pattern with the edges of the original
  PatternMesh mesh;             // the reference mesh with `rest` on it: vertices along edges lie on the drawn edges
  DrapeResult drape;
  FittingMap fit;
  double rms_stretch_error = 0.0;   // against the reference fit
  std::vector<double> pass_errors;  // of every pass tried, in order
  DerivePatternResult derivation;   // of the pass that is kept
  double kept_change = 1.0;         // below 1: this share of the change was kept of the panels held back
  std::vector<int> held_back;       // panels that would have overlapped themselves otherwise
};

// Requires and throws what derive_pattern and drape_from do. `on_target`: on the target body. `mirrors`: empty for a
// pattern that need not be symmetric.
DerivedPattern derive_in_loop(const Pattern& pattern, const PatternMesh& reference_mesh,
                              const FittingMap& reference_fit, DrapeSeries& on_target, const Drape& transported,
                              const GarmentMirrors& mirrors, const DerivePatternOptions& derive_options,
                              const DrapeOptions& drape_options, const DeriveInLoopOptions& options = {},
                              Progress* progress = nullptr);

}  // namespace toile
