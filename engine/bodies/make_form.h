// SPDX-License-Identifier: GPL-3.0-or-later
// Make a form: a closed surface of revolution about the y axis, standing on y = 0, on which a garment can be draped.
//
// Forms are dress forms and test solids: they have no limbs, and two forms of equal rings and segments share one
// topology, so that their body map is exact. Lengths in metres.
#pragma once

#include <string_view>
#include <utility>

#include "engine/core/body.h"

namespace toile {

struct MakeFormOptions {
  std::vector<std::pair<double, double>> profile;  // (height, radius), heights rising from 0, radii > 0; linear between
  int rings = 100;                                 // rows of quads between floor and top, >= 1
  int segments = 96;                               // around, >= 3
};

// Requires: a profile of at least two points. Ensures: closed, outward oriented, kind Form.
// Throws: OptionInvalid.
Body make_form(const MakeFormOptions& options);

// Built-in forms by name: "tube-R-H" is a tube of radius R and height H in centimetres ("tube-14-100").
// Throws: NotFound, naming what is known.
Body make_builtin_form(std::string_view name);

}  // namespace toile
