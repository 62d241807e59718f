// SPDX-License-Identifier: GPL-3.0-or-later
// The `toile` block of a garment document: what GarmentCode has no words for (allowances, notches, grain, fabric,
// pins).
#pragma once

#include "engine/core/pattern.h"
#include "engine/io/json.h"

namespace toile {

// Applies the block to a pattern whose panels and seams are already read. `metre_per_unit` scales grainlines, keep-out
// polygons and the symmetry plane's offset. Throws Error{FileMalformed} with the pointer of the offending value.
void read_toile_block(const JsonView& block, double metre_per_unit, Pattern& pattern);

// The block of `pattern` in units of `metre_per_unit`; an empty object when everything is at its default.
nlohmann::json write_toile_block(const Pattern& pattern, double metre_per_unit);

}  // namespace toile
