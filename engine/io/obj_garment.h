// SPDX-License-Identifier: GPL-3.0-or-later
// A garment from an OBJ whose texture coordinates are its flat pattern, as CLO and Marvelous Designer export it.
//
// Islands of texture coordinates become panels, borders that coincide in 3D become seams, the positions are the drape;
// the mesh is taken as it is. Outlines are cut into edges at corners (a turn over 30 degrees) and at the ends of seams,
// each a line, a cubic Bézier (within 0.2 mm) or a polyline. The order of a face's corners says which side is outside.
// Without a drape (flat positions) the seams come from a sidecar document:
//   { "schema": "toile/seams/1",
//     "seams": [ [ {"from": vt, "to": vt}, {"from": vt, "to": vt} ], ... ],    numbers of vt lines, counted from 1
//     "panels": { NAME: {"translation": [x, y, z], "rotation": [x, y, z], "label": "body"} },   cm, degrees
//     "toile": { ... } }                                                       as in a garment document, in cm
// `from` of one side meets `from` of the other; the first side runs along its outline, the second against it (with a
// third element "right_wrong" along it). A sidecar beside a draped garment adds labels, placements and the toile block.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

struct ObjGarmentOptions {
  std::optional<double> metre_per_uv_unit;  // 0.001, 0.01 or 1; empty: found by comparing flat and draped areas
  std::span<const std::uint8_t> sidecar;    // JSON; may be empty
};

struct ObjGarment {
  Pattern pattern;
  std::optional<PatternMesh> mesh;  // together with the drape
  std::optional<Drape> drape;       // none when the positions are flat
};

// `name` is the subject of errors. Throws Error{FileMalformed, LimitExceeded, GarmentInvalid, SeamInvalid}.
ObjGarment read_obj_garment(std::span<const std::uint8_t> bytes, const std::string& name,
                            const ObjGarmentOptions& options = {});

}  // namespace toile
