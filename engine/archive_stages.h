// SPDX-License-Identifier: GPL-3.0-or-later
// How the options and results of stages are archived (core/archive.h), field by field; options enter a stage's key.
// Every function names all fields of its type, so that it does not compile when one is added and forgotten here.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/alter_in_loop.h"
#include "engine/core/archive_values.h"
#include "engine/derive_in_loop.h"
#include "engine/drape_altered.h"
#include "engine/stages/derive_pattern.h"
#include "engine/stages/drape.h"
#include "engine/stages/fit_pattern_edges.h"
#include "engine/stages/mesh_panels.h"

namespace toile {

template <class A>
void archive(A& a, MeshPanelsOptions& v) {
  auto& [triangles, edge_length] = v;
  a(triangles, edge_length);
}

template <class A>
void archive(A& a, BodyLevels& v) {
  auto& [shoulder_y, armpit_y, waist_y, crotch_y] = v;
  a(shoulder_y, armpit_y, waist_y, crotch_y);
}
template <class A>
void archive(A& a, BodyGuides& v) {
  auto& [levels, shoulder_z, arm, leg, arm_direction] = v;
  a(levels, shoulder_z, arm, leg, arm_direction);
}
template <class A>
void archive(A& a, DrapeOptions& v) {
  auto& [friction, gravity, thickness, sag_radius, contact_stiffness, iterations, stop_residual, stop_settled, lift,
         drafted_for, pin_openings, keep_drape, solver, newton_residual, fibre_slack, shear_limit_deg, self_contact,
         first_rung, coarse_triangles, halve] = v;
  a(friction, gravity, thickness, sag_radius, contact_stiffness, iterations, stop_residual, stop_settled, lift,
    drafted_for, pin_openings, keep_drape, solver, newton_residual, fibre_slack, shear_limit_deg, self_contact,
    first_rung, coarse_triangles, halve);
}
template <class A>
void archive(A& a, DrapeFinding& v) {
  auto& [name, message, refused] = v;
  a(name, message, refused);
}
template <class A>
void archive(A& a, DrapeDiagnostics& v) {
  auto& [upper_shift, bodice, hold_height, moved_nodes, sewing_iterations, iterations, evaluations, energy, stalled,
         tangled, rung, findings] = v;
  a(upper_shift, bodice, hold_height, moved_nodes, sewing_iterations, iterations, evaluations, energy, stalled, tangled,
    rung, findings);
}
template <class A>
void archive(A& a, StrainPercentiles& v) {
  auto& [p50, p99] = v;
  a(p50, p99);
}
template <class A>
void archive(A& a, DrapeQuality& v) {
  auto& [rest, residual, settling_move, weft, warp, shear, deepest_node, nodes_inside, deepest_edge, edges_inside,
         crossing_pairs, crossing_share, seam_gap] = v;
  a(rest, residual, settling_move, weft, warp, shear, deepest_node, nodes_inside, deepest_edge, edges_inside,
    crossing_pairs, crossing_share, seam_gap);
}
template <class A>
void archive(A& a, DrapeResult& v) {
  auto& [drape, quality, diagnostics] = v;
  a(drape, quality, diagnostics);
}

template <class A>
void archive(A& a, DerivePatternOptions& v) {
  auto& [max_sweeps, energy_drop, seam_weight, keep_straight, smooth] = v;
  a(max_sweeps, energy_drop, seam_weight, keep_straight, smooth);
}
template <class A>
void archive(A& a, DeriveSweep& v) {
  auto& [edge_weight, energy, fit_residual, seam_residual] = v;
  a(edge_weight, energy, fit_residual, seam_residual);
}
template <class A>
void archive(A& a, DerivePatternResult& v) {
  auto& [rest, sweeps, converged, fit_residual, seam_residual, flipped_triangles] = v;
  a(rest, sweeps, converged, fit_residual, seam_residual, flipped_triangles);
}
template <class A>
void archive(A& a, DeriveInLoopOptions& v) {
  auto& [max_passes, good_enough, least_gain, least_nearer] = v;
  a(max_passes, good_enough, least_gain, least_nearer);
}
template <class A>
void archive(A& a, PositionDifference& v) {
  auto& [rms, p95, largest, worst_node] = v;
  a(rms, p95, largest, worst_node);
}
template <class A>
void archive(A& a, TriedOn& v) {
  auto& [problem, mesh, drape, position] = v;
  a(problem, mesh, drape, position);
}
template <class A>
void archive(A& a, DrapedAlteration& v) {
  auto& [problem, mesh, drape, fit, reference, position] = v;
  a(problem, mesh, drape, fit, reference, position);
}

template <class A>
void archive(A& a, FitPatternEdgesResult& v) {
  auto& [pattern, deviation, largest_deviation, largest_seam_mismatch, bent_edges, polyline_edges] = v;
  a(pattern, deviation, largest_deviation, largest_seam_mismatch, bent_edges, polyline_edges);
}

template <class A>
void archive(A& a, DerivedPattern& v) {
  auto& [drawn, mesh, drape, fit, rms_stretch_error, pass_errors, derivation, kept_change, held_back] = v;
  a(drawn, mesh, drape, fit, rms_stretch_error, pass_errors, derivation, kept_change, held_back);
}

template <class A>
void archive(A& a, AlterPatternOptions& v) {
  auto& [max_tears_per_side, seam_preference, stretch_limit, planned_share, l_shapes, symmetric, choice, mesh_edge_cuts,
         cut_smoothness, least_strip, least_change, least_allowance_left] = v;
  a(max_tears_per_side, seam_preference, stretch_limit, planned_share, l_shapes, symmetric, choice, mesh_edge_cuts,
    cut_smoothness, least_strip, least_change, least_allowance_left);
}
template <class A>
void archive(A& a, TicketSide& v) {
  auto& [panel, edges, words, amount] = v;
  a(panel, edges, words, amount);
}
template <class A>
void archive(A& a, TicketProfile& v) {
  auto& [spacing, amounts] = v;
  a(spacing, amounts);
}
template <class A>
void archive(A& a, TicketAllowance& v) {
  auto& [available, needed, left] = v;
  a(available, needed, left);
}
template <class A>
void archive(A& a, TicketPiece& v) {
  auto& [name, label, width, length, area, grain_angle, seam_allowance, quantity] = v;
  a(name, label, width, length, area, grain_angle, seam_allowance, quantity);
}
template <class A>
void archive(A& a, TicketOperation& v) {
  auto& [kind, where, sides, per_ply, total, largest_at, tapers_to, taper_length, least, least_at, profile, allowance,
         fabric, pieces, with_step, removed_area, touches, below_accuracy, sentence] = v;
  a(kind, where, sides, per_ply, total, largest_at, tapers_to, taper_length, least, least_at, profile, allowance,
    fabric, pieces, with_step, removed_area, touches, below_accuracy, sentence);
}
template <class A>
void archive(A& a, Ticket& v) {
  auto& [garment, reference_body, target_body, operations, notes] = v;
  a(garment, reference_body, target_body, operations, notes);
}
template <class A>
void archive(A& a, PolygonWithHoles& v) {
  auto& [outline, holes] = v;
  a(outline, holes);
}
template <class A>
void archive(A& a, AlteredRegion& v) {
  auto& [name, shape, area, operation] = v;
  a(name, shape, area, operation);
}
template <class A>
void archive(A& a, SheetStress& v) {
  auto& [energy, p95, p98, way, shift, lean, area] = v;
  a(energy, p95, p98, way, shift, lean, area);
}
template <class A>
void archive(A& a, Tear& v) {
  auto& [kind, panel, side, at, direction] = v;
  a(kind, panel, side, at, direction);
}
template <class A>
void archive(A& a, MadeTear& v) {
  auto& [tear, round, weight, release, largest_gap, for_partner] = v;
  a(tear, round, weight, release, largest_gap, for_partner);
}
template <class A>
void archive(A& a, PanelTearing& v) {
  auto& [before, after, tears, done, overlaps, reason] = v;
  a(before, after, tears, done, overlaps, reason);
}
template <class A>
void archive(A& a, PanelAlteration& v) {
  auto& [panel, original, target, kept, cut_lines, kept_in_target, insertions, removals, cut_back, insertion_pass,
         removal_pass] = v;
  a(panel, original, target, kept, cut_lines, kept_in_target, insertions, removals, cut_back, insertion_pass,
    removal_pass);
}
template <class A>
void archive(A& a, PieceMap& v) {
  auto& [rest, target, triangles, border_count] = v;
  a(rest, target, triangles, border_count);
}
template <class A>
void archive(A& a, SewnPiece& v) {
  auto& [panel, insertion, recut, own_cloth, strain, turned_over, map] = v;
  a(panel, insertion, recut, own_cloth, strain, turned_over, map);
}
template <class A>
void archive(A& a, SewnSeam& v) {
  auto& [added, length_a, length_b, eased] = v;
  a(added, length_a, length_b, eased);
}
template <class A>
void archive(A& a, SewnPattern& v) {
  auto& [pattern, pieces, seams, flags] = v;
  a(pattern, pieces, seams, flags);
}
template <class A>
void archive(A& a, AlterPatternResult& v) {
  auto& [panels, ticket, original_area, target_area, inserted_area, removed_area, area_imbalance, planned_share,
         strain_left, insertion_rounds, removal_rounds, trials, reverted, dropped_regions, sewn, flags] = v;
  a(panels, ticket, original_area, target_area, inserted_area, removed_area, area_imbalance, planned_share, strain_left,
    insertion_rounds, removal_rounds, trials, reverted, dropped_regions, sewn, flags);
}
template <class A>
void archive(A& a, AlterInLoopOptions& v) {
  auto& [max_plans, share_of_ideal, farther_off, check_triangles] = v;
  a(max_plans, share_of_ideal, farther_off, check_triangles);
}
template <class A>
void archive(A& a, TriedPlan& v) {
  auto& [share, operations, faults, problem, triangles, position] = v;
  a(share, operations, faults, problem, triangles, position);
}
template <class A>
void archive(A& a, PlacedPlans& v) {
  auto& [ideal, meshed_anew, allowed, plans, kept] = v;
  a(ideal, meshed_anew, allowed, plans, kept);
}
template <class A>
void archive(A& a, AlterInLoopResult& v) {
  auto& [altered, worn, place] = v;
  a(altered, worn, place);
}

}  // namespace toile
