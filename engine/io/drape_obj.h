// SPDX-License-Identifier: GPL-3.0-or-later
// A draped garment as OBJ: what other programs open to look at it, and what Toile reads back as a garment.
//
// `v` in metres on the body, `vt` rest coordinates in centimetres (each panel's own plane), one `o` group per panel,
// faces in the order of the mesh, wound so that the cloth's right side faces outward. Deterministic.
// With a wanted fit every face is followed by its tensor, in a comment that other programs skip:
//   #fit A B C      [[A, B], [0, C]], A and C about 1: the fitting map (core/fitting_map.h) asked for
#pragma once

#include "engine/core/drape.h"
#include "engine/core/fitting_map.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

// `wanted`: of the mesh's triangles; what the garment is to fit like when it is altered again.
Bytes write_drape_obj(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape,
                      const FittingMap* wanted = nullptr);

}  // namespace toile
