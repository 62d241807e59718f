// SPDX-License-Identifier: GPL-3.0-or-later
// Ready-made mannequins by the size on the label.
//
//   woman-38-168   size 32, 34 ... 56, height 145 to 195 cm; bust = 2 size + 12 up to 46, then 6 cm a size (German DOB)
//   man-50-178     size 44, 46 ... 60, height 155 to 205 cm; chest = 2 size
//   child-128      height 86 to 176 cm; size = height (EN 13402-3)
#pragma once

#include <optional>
#include <string_view>

#include "engine/bodies/make_mannequin.h"

namespace toile {

struct NamedMannequin {
  Figure figure = Figure::Person;
  Measurements measurements;  // the key figures of the size; the rest is completed
};

// Nothing if the name is not one of the above.
std::optional<NamedMannequin> find_named_mannequin(std::string_view name);

}  // namespace toile
