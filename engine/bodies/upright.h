// SPDX-License-Identifier: GPL-3.0-or-later
// Which axis of a file points to the head.
#pragma once

#include <string_view>

#include "engine/core/body.h"

namespace toile {

enum class UpAxis { PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };
std::string_view up_name(UpAxis up);  // "+x" ... "-z"

// Proper rotation that takes the axis to +Y.
Mat3 turn_upright(UpAxis up);

// How much the slices look like a standing person: the share of levels at 6-40 % of the height with exactly two pieces
// (legs) plus the share at 84-97 % with exactly one (head). 0..2; persons reach 1.9, a cube 1.0.
// Source: shared design page "registration", section 1.1.
double upright_score(const TriangleMesh& body, UpAxis up);

struct Upright {
  UpAxis up = UpAxis::PlusY;
  double score = -1.0;
};
// The best of the axes along which the body is nearly as long as along its longest.
Upright find_upright(const TriangleMesh& body);

}  // namespace toile
