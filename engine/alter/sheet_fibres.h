// SPDX-License-Identifier: GPL-3.0-or-later
// What the cloth of a sheet wants in one face: fibres of a length, near a right angle to each other. Dimensionless.
#pragma once

#include "engine/core/types.h"

namespace toile {

// Lengths of weft and warp that cloth takes without stress where the plain map has the gradient `guide`: it may shrink
// as the plain map has it and never grows; what is folded takes any width.
Vec2 wanted_lengths(const Mat2& guide, bool folded);

// Nearest gradient whose fibres have the lengths `length` and stand within the shear limit (90 +- 5 degrees), there
// with the share `shear_kept` of the shear they have: below 1 the cloth resists shear.
Mat2 fibre_projection(const Mat2& gradient, const Vec2& length, double shear_kept = 1.0);

}  // namespace toile
