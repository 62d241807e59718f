// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stage_options.h"

#include "engine/core/units.h"

namespace toile {
namespace {

// Of the drape, in mean node weights. At 4,000 triangles a tighter one changes neither stretch nor pattern by a tenth.
constexpr double kDraftResidual = 1.0;
constexpr double kFineResidual = 0.1;
// Of the derivation: a second pass is always tried, and kept where it is clearly nearer.
constexpr double kFineStretchError = 0.002, kFineNearer = 0.1;

}  // namespace

MeshPanelsOptions mesh_options_of(const AlterOptions& options) {
  return {.triangles = garment_triangles(options)};
}

DrapeOptions drape_options_of(const AlterOptions& options) {
  DrapeOptions drape;
  drape.solver = options.solver;
  drape.self_contact = options.self_contact;
  drape.pin_openings = options.pin_extremities;
  drape.fibre_slack = options.fibre_slack;
  drape.shear_limit_deg = options.shear_limit_deg;
  if (options.preset == Preset::Draft) drape.stop_residual = kDraftResidual;
  if (options.preset == Preset::Fine) drape.stop_residual = kFineResidual;
  return drape;
}

std::optional<PresetError> measured_error(const AlterOptions& options) {
  AlterOptions plain;  // what a job that names no number of triangles is kept as
  plain.preset = options.preset;
  if (garment_triangles(options) != garment_triangles(plain) || options.solver != SolverKind::Default)
    return std::nullopt;
  switch (options.preset) {
    case Preset::Draft: return PresetError{0.0049, 4.23e-3, 1.57e-3};
    case Preset::Standard: return PresetError{0.0023, 2.90e-3, 1.38e-3};
    case Preset::Fine: return PresetError{0.0014, 1.93e-3, 0.66e-3};
  }
  return std::nullopt;
}

DerivePatternOptions derive_options_of(const AlterOptions&) {
  return {};
}

std::optional<MirrorPlane> mirror_plane_of(const AlterOptions& options, const Pattern& pattern) {
  if (options.symmetry == SymmetryMode::Off) return std::nullopt;
  if (pattern.symmetry == Pattern::Symmetry::Plane) return pattern.symmetry_plane;
  if (pattern.symmetry == Pattern::Symmetry::None && options.symmetry == SymmetryMode::Auto) return std::nullopt;
  return kMidPlane;
}

DeriveInLoopOptions loop_options_of(const AlterOptions& options) {
  DeriveInLoopOptions loop;
  loop.max_passes = options.physics_passes;
  if (options.preset == Preset::Fine) loop.good_enough = kFineStretchError, loop.least_nearer = kFineNearer;
  return loop;
}

AlterInLoopOptions plan_options_of(const AlterOptions& options) {
  AlterInLoopOptions loop;
  loop.max_plans = options.alteration_plans;
  return loop;
}

AlterPatternOptions alter_options_of(const AlterOptions& options) {
  AlterPatternOptions alter;
  alter.max_tears_per_side = options.max_tears_per_side;
  alter.seam_preference = options.seam_preference;
  alter.stretch_limit = options.stretch_limit;
  alter.l_shapes = options.l_shapes;
  alter.symmetric = options.symmetry != SymmetryMode::Off;
  switch (options.tear_weights) {
    case TearWeights::Release: alter.choice = TearChoice::Release; break;
    case TearWeights::Boundary: alter.choice = TearChoice::Boundary; break;
    case TearWeights::Greedy: alter.choice = TearChoice::Greedy; break;
  }
  alter.mesh_edge_cuts = options.cuts == CutKind::MeshEdges;
  alter.cut_smoothness = options.cut_smoothness;
  alter.least_strip = options.min_strip_mm * kMetrePerMm;
  alter.least_change = options.min_change_mm * kMetrePerMm;
  return alter;
}

}  // namespace toile
