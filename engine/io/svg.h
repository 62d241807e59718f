// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings as SVG at true scale.
//
// Width, height and viewBox in mm (one user unit is one millimetre); one group per piece, an Inkscape layer with the
// piece's name; one class per kind of line (cut, stitch, fold, internal, grainline, insertion, removal, original),
// `notch` and `label`; a 100 mm square to check the scale.
#pragma once

#include "engine/core/drawing.h"

namespace toile {

struct SvgOptions {
  bool test_square = true;
  bool inlined = false;  // for embedding in HTML: no XML head; scales to the width of its place
};

Bytes write_svg(const Drawing& drawing, const SvgOptions& options = {});

}  // namespace toile
