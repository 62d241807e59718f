// SPDX-License-Identifier: GPL-3.0-or-later
// Turn the flat panels into triangles whose borders pair up along every seam.
//
// Both sides of a seam get the same number of vertices, evenly by arc length, so that easing is spread; corners and
// notches are vertices unless their edge is shorter than a quarter of the target length (then it collapses on both
// sides). Panels listed clockwise are meshed counter-clockwise. Mirror pairs of panels, and panels with a mirror axis,
// get mirrored meshes. Sewn vertices share a garment node, also across seams that meet in a point. Requires: a
// validated pattern. Ensures: det Dm > 0, no triangle under 1e-9 m^2, corners of a triangle at three different nodes,
// vertices and triangles of a panel contiguous, its boundary vertices first. Source: GarmentCode's box mesh,
// [Eggler2024, Sec. 7].
#pragma once

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/core/progress.h"

namespace toile {

struct MeshPanelsOptions {
  int triangles = 10000;              // of the whole garment, met within some percent; 500-200000
  std::optional<double> edge_length = {};  // m; target instead of a count, > 0
};

// Throws Error{OptionInvalid} (targets out of range), Error{GarmentInvalid} (a panel too thin to be meshed), Cancelled.
PatternMesh mesh_panels(const Pattern& pattern, const MeshPanelsOptions& options = {}, Progress* progress = nullptr);

}  // namespace toile
