// SPDX-License-Identifier: GPL-3.0-or-later
// A garment as it hangs on a body, beside its pattern: the OBJ of write_drape_obj read back, vertex for vertex, so that
// the pattern keeps its edges, seams and allowances, which an OBJ alone cannot tell.
#pragma once

#include <span>
#include <string>

#include "engine/core/drape.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

struct WornGarment {
  PatternMesh mesh;
  Drape drape;  // metres, in the file's frame
  std::vector<Mat2>
      wanted;  // per triangle, the fit it was derived for ([[a, b], [0, c]]); empty where the file has none
};

// `pattern`: the one it was written with; `name` is the subject of errors. Throws Error{FileMalformed, LimitExceeded}
// for a file that cannot be read, Error{GarmentInvalid} for one that does not belong to the pattern.
WornGarment read_worn_garment(std::span<const std::uint8_t> bytes, const std::string& name, const Pattern& pattern);

}  // namespace toile
