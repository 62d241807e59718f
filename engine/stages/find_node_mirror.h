// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a dressed body is the same on the left and the right, and which nodes of its garment lie opposite each other.
#pragma once

#include <optional>

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/sim/node_mirror.h"

namespace toile {

// `start` (#N x 3): the garment about the body, as placed or worn. Empty unless: every vertex of `surface` has one
// opposite within 0.05 mm; every panel has a mirror image among the panels, meshed alike, of the same grain; and the
// start is symmetric within 1 cm rms.  Metres.
std::optional<NodeMirror> find_node_mirror(const Pattern& pattern, const PatternMesh& mesh, const Cloth& cloth,
                                           const Points3& surface, const Points3& start);

// Puts nodes that lie a little on the wrong side of the middle, as the cloth of legs that touch does once it is sewn,
// on the middle; false: some lie farther over it, as fronts do of which one covers the other.
bool part_sides(const NodeMirror& mirror, Points3& nodes);

}  // namespace toile
