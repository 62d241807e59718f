// SPDX-License-Identifier: GPL-3.0-or-later
// How the options and results of stages are archived (core/archive.h), field by field; options enter a stage's key.
#pragma once

#include "engine/core/archive_values.h"
#include "engine/derive_in_loop.h"
#include "engine/stages/derive_pattern.h"
#include "engine/stages/drape.h"
#include "engine/stages/mesh_panels.h"

namespace toile {

template <class A>
void archive(A& a, MeshPanelsOptions& v) {
  a(v.triangles, v.edge_length);
}

template <class A>
void archive(A& a, DrapeOptions& v) {
  a(v.friction, v.gravity, v.thickness, v.sag_radius, v.contact_stiffness, v.iterations, v.stop_residual, v.keep_drape);
}
template <class A>
void archive(A& a, DrapeDiagnostics& v) {
  a(v.sewing_iterations, v.iterations, v.evaluations, v.energy, v.residual, v.stalled);
}
template <class A>
void archive(A& a, StrainPercentiles& v) {
  a(v.p50, v.p99);
}
template <class A>
void archive(A& a, DrapeQuality& v) {
  a(v.rest, v.residual, v.settling_move, v.weft, v.warp, v.shear, v.deepest_node, v.nodes_inside, v.deepest_edge,
    v.edges_inside, v.crossing_pairs, v.crossing_share, v.seam_gap);
}
template <class A>
void archive(A& a, DrapeResult& v) {
  a(v.drape, v.quality, v.diagnostics);
}

template <class A>
void archive(A& a, DerivePatternOptions& v) {
  a(v.max_sweeps, v.energy_drop, v.seam_weight, v.keep_straight);
}
template <class A>
void archive(A& a, DeriveSweep& v) {
  a(v.edge_weight, v.energy, v.fit_residual, v.seam_residual);
}
template <class A>
void archive(A& a, DerivePatternResult& v) {
  a(v.rest, v.sweeps, v.converged, v.fit_residual, v.seam_residual, v.flipped_triangles);
}
template <class A>
void archive(A& a, DeriveInLoopOptions& v) {
  a(v.max_passes, v.good_enough, v.least_gain);
}
template <class A>
void archive(A& a, DerivedPattern& v) {
  a(v.mesh, v.drape, v.fit, v.rms_stretch_error, v.pass_errors, v.derivation);
}

}  // namespace toile
