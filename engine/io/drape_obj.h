// SPDX-License-Identifier: GPL-3.0-or-later
// A draped garment as OBJ: what other programs open to look at it, and what Toile reads back as a garment.
//
// `v` in metres on the body, `vt` rest coordinates in centimetres (each panel's own plane), one `o` group per panel,
// faces in the order of the mesh, wound so that the cloth's right side faces outward. Deterministic.
#pragma once

#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

Bytes write_drape_obj(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape);

}  // namespace toile
