// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fabric.h"

#include <array>

namespace toile {

namespace {

// name, weft, warp, shear (N/m), bending (N m), density (kg/m^2)
const std::array<Fabric, 6> kFabrics = {{{},
                                         {"denim", 2000.0, 2500.0, 150.0, 1e-4, 0.40},
                                         {"jersey", 150.0, 200.0, 60.0, 1e-5, 0.20},
                                         {"linen", 1500.0, 1500.0, 60.0, 4e-5, 0.18},
                                         {"silk", 1000.0, 1000.0, 30.0, 5e-6, 0.08},
                                         {"wool", 700.0, 800.0, 40.0, 3e-5, 0.25}}};

}  // namespace

std::optional<Fabric> fabric_named(std::string_view name) {
  for (const Fabric& fabric : kFabrics)
    if (fabric.name == name) return fabric;
  return std::nullopt;
}

std::vector<std::string> fabric_names() {
  std::vector<std::string> names;
  for (const Fabric& fabric : kFabrics) names.push_back(fabric.name);
  return names;
}

}  // namespace toile
