// SPDX-License-Identifier: GPL-3.0-or-later
// What a cloth is made of, as the drape needs it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace toile {

struct Fabric {
  std::string name = "cotton";
  double weft_stiffness = 1000.0;   // N/m, membrane, along the pattern's u (across the grain), > 0
  double warp_stiffness = 1000.0;   // N/m, along v (the grain), > 0
  double shear_stiffness = 60.0;    // N/m, > 0
  double bending_stiffness = 2e-5;  // N m, >= 0
  double density = 0.15;            // kg/m^2, > 0
};

// The fabrics a garment may name: cotton (the defaults above), denim, jersey, linen, shirting, silk,
// stretch_jersey, wool. Figures of tensile, shear and bending tests (fabric.cpp); empty for any other name.
std::optional<Fabric> fabric_named(std::string_view name);
std::vector<std::string> fabric_names();

}  // namespace toile
