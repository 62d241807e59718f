// SPDX-License-Identifier: GPL-3.0-or-later
// What the options of a job mean to each stage.
#pragma once

#include "engine/alter/alter_pattern.h"
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
AlterPatternOptions alter_options_of(const AlterOptions& options);

}  // namespace toile
