// SPDX-License-Identifier: GPL-3.0-or-later
// Derive the flat pattern whose sewn, relaxed shape is `target_drape` and whose fit there is the reference fit.
//
// Unknown: the flat position U of every pattern vertex.  Minimise
//   sum_f A_f |G_f(U) - J_f^-1 R_f M_f|^2  +  lambda sum_e |e(U) - t_e|^2  +  w sum_s |X_s(U) - P_s X_s(U)|^2
// with G_f the gradient from the reference pattern to U, M_f that to the flattened triangle of the target drape, J_f
// the wanted fitting tensor, e the outline edges whose length (seams) or shape (straight, locked) is prescribed, and
// P_s X_s the smooth part of a side's vertices.
//   local step: a rotation R_f per triangle on the drape's side, a wanted vector t_e per edge
//   global step: one solve with a matrix factored once per lambda; lambda grows from 0, warm started
// At the end panels are turned to lie over the original as fits best, as far as the fit hardly tells how they are turned.
// Mirror images (GarmentMirrors) stay mirror images: the energy is minimised over symmetric patterns alone.
// Source: [Eggler2024, Sec. 5.1 and 8], [LZX*08].  Lengths in metres.
#pragma once

#include "engine/core/fitting_map.h"
#include "engine/core/progress.h"
#include "engine/stages/garment_mirrors.h"

namespace toile {

struct DerivePatternOptions {
  int max_sweeps = 220;       // local-global sweeps in all, >= 1
  double energy_drop = 1e-6;  // end a stage when a sweep gains less than this; relative, > 0
  double seam_weight = 1e4;   // last of the continuation 0, 10, 100, ... that closes the seam lengths; relative, >= 0
  bool keep_straight = true;  // straight hems, darts, folds and edges along the grain stay so; `straight` overrides
  bool smooth = true;         // sides move smoothly: specks of a scan leave no wobble in the outline
};

// One local-global sweep: what the energy was after it.
struct DeriveSweep {
  double edge_weight = 0.0;    // lambda
  double energy = 0.0;         // at this lambda, m^2; never grows while lambda stays
  double fit_residual = 0.0;   // sqrt(sum A |G - J^-1 R M|^2 / sum A), dimensionless
  double seam_residual = 0.0;  // largest difference of a sewn pair of mesh edges from its intended ratio, m
};

struct DerivePatternResult {
  Points2 rest;  // #V x 2, flat positions of the target pattern, m; corner 0 of each panel stays
  std::vector<DeriveSweep> sweeps;
  bool converged = false;      // the last stage ended by `energy_drop`
  double fit_residual = 0.0;   // as in the last sweep
  double seam_residual = 0.0;  // largest difference of a whole sewn side from its intended ratio, m
  int flipped_triangles = 0;   // with det G <= 0; none in a usable pattern
};

// Requires: reference_fit of reference_mesh's triangles, target_drape of its nodes; reference_mesh made from `pattern`;
// `mirrors` of them, or empty for a pattern that need not be symmetric; `near`, where it is known, what an earlier
// call returned for the same reference and a shape much like this one: fewer sweeps will do.
// Ensures: locked panels keep their shape exactly; the energy never grows while lambda stays.
// Throws: DerivationFailed when the system cannot be factored; Cancelled.
DerivePatternResult derive_pattern(const Pattern& pattern, const PatternMesh& reference_mesh,
                                   const FittingMap& reference_fit, const Drape& target_drape,
                                   const GarmentMirrors& mirrors = {}, const DerivePatternOptions& options = {},
                                   Progress* progress = nullptr, const Points2* near = nullptr);

// The inside of panels whose outlines are given: vertices along edges stay where `outline` (#V x 2, m) has them, the
// others minimise the same energy. Throws as derive_pattern.
DerivePatternResult derive_inside(const PatternMesh& reference_mesh, const FittingMap& reference_fit,
                                  const Drape& target_drape, const Points2& outline, const GarmentMirrors& mirrors = {},
                                  const DerivePatternOptions& options = {}, Progress* progress = nullptr);

}  // namespace toile
