// SPDX-License-Identifier: GPL-3.0-or-later
// Cut a sheet along a straight line through a conforming remesh, and sew such a cut up again.
// Straight cuts are exact and independent of the mesh; cuts along mesh edges zig-zag [method, Sec. 5].
#pragma once

#include "engine/alter/sheet.h"

namespace toile {

// Straight from border vertex `start` along `direction` (unit, in `flat`) to the first border or existing cut, snapping
// vertices within 0.3 edge lengths onto the line and splitting the triangles it crosses. Appends to sheet.cuts; false,
// when the direction leaves the cloth at once.
bool cut_straight(Sheet& sheet, int start, const Vec2& direction);

// Along mesh edges, each the one nearest to `direction`, which keeps the share `smoothness` of the direction before.
bool cut_along_edges(Sheet& sheet, int start, const Vec2& direction, double smoothness);

// Sews cut `number` up from lip pair `first` on: those pairs become one vertex again.
void zip_from(Sheet& sheet, std::size_t number, std::size_t first);

// Distance between the lips of pair `i` now, m.
double gap(const Sheet& sheet, const Cut& cut, std::size_t i);

}  // namespace toile
