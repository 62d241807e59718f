// SPDX-License-Identifier: GPL-3.0-or-later
// GarmentCode specifications (JSON) with the optional `toile` block, read from untrusted bytes and written back.
//
// The reader follows pygarment's loader: curve parameters relative to their edge, arcs by radius, placement
// R = Rz Ry Rx, file units by `units_in_meter`. Panel k of the result is entry k of `panel_order` (panels it does not
// list follow by name); edges keep their numbers, seam k is stitch k. The outline's winding is kept: it says which face
// is the outside. Coordinates of the `toile` block are in the units of the file.
#pragma once

#include <span>
#include <string>

#include "engine/core/pattern.h"
#include "engine/core/record.h"

namespace toile {

inline constexpr int kMaxPanels = 200;
inline constexpr int kMaxEdgesPerPanel = 2000;
inline constexpr double kMaxCoordinate = 100.0;  // m

// Requires nothing of the bytes. Throws Error with the JSON pointer as subject: FileMalformed (syntax, types, indices),
// LimitExceeded, SeamInvalid (a stitch names a panel or edge that is not there). Geometry is not judged here:
// stages/import_pattern does that.
Pattern read_garmentcode(std::span<const std::uint8_t> bytes);

// The same document again, in centimetres; each edge with its own type of curve. Fields at their defaults are left out,
// the `toile` block too when nothing in it differs. Deterministic.
std::string write_garmentcode(const Pattern& pattern);

// The same with what else is known of an altered pattern, at top level under "alteration"; readers pass over it.
std::string write_altered_pattern(const Pattern& pattern, const Record& alteration);

// The turn of a placement: about the fixed world axes X, then Y, then Z, in degrees.
Mat3 rotation_of_degrees(const Vec3& degrees);

}  // namespace toile
