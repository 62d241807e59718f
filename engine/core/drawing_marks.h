// SPDX-License-Identifier: GPL-3.0-or-later
// The marks of a drawing as plain lines, the same in every format. Millimetres, y up.
#pragma once

#include "engine/core/drawing.h"

namespace toile {

// A notch as one polyline, from the cut line inwards.
std::vector<Vec2> notch_outline(const DrawingNotch& notch);

// A grainline with a head at both ends, as polylines; `line` has two points or none.
std::vector<std::vector<Vec2>> grainline_strokes(const DrawingLine& line);

}  // namespace toile
