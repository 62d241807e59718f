// SPDX-License-Identifier: GPL-3.0-or-later
// Turn a garment file into a pattern that every later stage may rely on.
//
// Reads a GarmentCode specification (JSON, with or without the `toile` block), or an OBJ whose texture coordinates are
// the pattern and whose positions are its drape, and proves: outlines closed, free of
// self-crossings and not degenerate; every stitched edge exists and is sewn once; panel and edge sizes within human
// garments. Source: the format as documented by GarmentCode's loader. Lengths in metres.
#pragma once

#include <span>

#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/core/progress.h"

namespace toile {

struct ImportGarmentOptions {
  std::optional<double> metre_per_uv_unit;  // of an OBJ's texture coordinates: 0.001, 0.01 or 1; empty: found
  std::span<const std::uint8_t> sidecar;  // JSON beside an OBJ: seams of a flat one, labels, toile block; may be empty
};

struct ImportedGarment {
  Pattern pattern;
  std::optional<PatternMesh> mesh;  // of a draped OBJ, as it is in the file
  std::optional<Drape> drape;       // of its nodes, metres, in the file's frame
};

// Either format. `name` is the subject of errors about an OBJ file; otherwise as import_pattern.
ImportedGarment import_garment(std::span<const std::uint8_t> bytes, const std::string& name,
                               const ImportGarmentOptions& options = {}, Progress* progress = nullptr);

// A GarmentCode specification. Ensures the guarantees above. Throws Error{FileMalformed, LimitExceeded, GarmentInvalid,
// SeamInvalid}; the subject is the JSON pointer of the offending value, the message names panel and edge and says what
// would mend it.
Pattern import_pattern(std::span<const std::uint8_t> bytes, Progress* progress = nullptr);

// The geometric and seam checks alone, for patterns that do not come from a file. Subjects are the JSON pointers that
// the pattern has when written as a GarmentCode specification.
void validate_pattern(const Pattern& pattern);

}  // namespace toile
