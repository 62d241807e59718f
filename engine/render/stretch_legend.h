// SPDX-License-Identifier: GPL-3.0-or-later
// The key to stretch_colour(): a bar of colours with numbers in per cent.
#pragma once

#include "engine/render/canvas.h"

namespace toile {

inline constexpr int kStretchLegendWidth = 96;  // pixels

// Upper left corner at `at`; `height` includes the heading, pixels.
void draw_stretch_legend(Canvas& canvas, const Vec2& at, double height, double scale);

}  // namespace toile
