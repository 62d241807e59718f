// SPDX-License-Identifier: GPL-3.0-or-later
// What the options of a job mean to each stage.
#pragma once

#include "engine/alter_in_loop.h"
#include "engine/core/options.h"
#include "engine/derive_in_loop.h"
#include "engine/stages/mesh_panels.h"

namespace toile {

MeshPanelsOptions mesh_options_of(const AlterOptions& options);
DrapeOptions drape_options_of(const AlterOptions& options);
DerivePatternOptions derive_options_of(const AlterOptions& options);
// The plane whose two sides of the pattern are kept alike; empty: they need not be.
std::optional<MirrorPlane> mirror_plane_of(const AlterOptions& options, const Pattern& pattern);
DeriveInLoopOptions loop_options_of(const AlterOptions& options);
AlterInLoopOptions plan_options_of(const AlterOptions& options);
AlterPatternOptions alter_options_of(const AlterOptions& options);

// How far a preset's answer is from that of the fine one with 40,000 triangles (residual 0.1): the worst of the
// scenes leggings_tight, tshirt_fitted, dress_sleeveless, skirt_pencil (tests/bench/results/pareto.csv).
struct PresetError {
  double stretch = 0.0;   // rms of weft and warp of the reference drape's fitting map, dimensionless
  double position = 0.0;  // rms of its nodes, m
  double pattern = 0.0;   // rms of the derived outlines, m
};
// Empty where it was not measured: other resolutions and solvers than the preset's own.
std::optional<PresetError> measured_error(const AlterOptions& options);

}  // namespace toile
