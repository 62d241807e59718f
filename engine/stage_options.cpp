// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stage_options.h"

namespace toile {

MeshPanelsOptions mesh_options_of(const AlterOptions& options) {
  return {.triangles = garment_triangles(options)};
}

DrapeOptions drape_options_of(const AlterOptions&) {
  return {};
}

DerivePatternOptions derive_options_of(const AlterOptions&) {
  return {};
}

DeriveInLoopOptions loop_options_of(const AlterOptions& options) {
  DeriveInLoopOptions loop;
  loop.max_passes = options.physics_passes;
  return loop;
}

}  // namespace toile
