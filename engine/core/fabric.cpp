// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fabric.h"

#include <array>

namespace toile {

namespace {

// name, weft, warp, shear (N/m), bending (N m), density (kg/m^2).
//   wool: worsted suiting of 168 g/m^2 on FAST: bending 5.3e-6 N m, extension at 98 N/m 4.6 % and 5.9 %, shear rigidity
//     26 N/m, which is half of the shear stiffness here [FAST].
//   denim: shear 1.5-3.4 gf/cm/degree, that is 84-191 N/m of rigidity, bending 0.14-0.23 gf cm^2/cm after washing and
//     several times that before [KESDenim]; weight of a 12 oz cloth.
//   shirting, silk: weights of common cloths; bending so that the drape coefficient lies in the published band
//     (cotton shirting 60-76 %, silk 20-40 %, wool 40-70 %, denim 70-90 %; [ISO9073-9]).
//   jersey, stretch_jersey: secant of the extension at the 88 N/m under which knits are compared [ASTM D2594].
// What each gives in the laboratory: toile-bench fabrics.
const std::array<Fabric, 8> kFabrics = {{{},
                                         {"denim", 2000.0, 2500.0, 150.0, 5e-5, 0.40},
                                         {"jersey", 150.0, 200.0, 60.0, 1e-5, 0.20},
                                         {"linen", 1500.0, 1500.0, 60.0, 4e-5, 0.18},
                                         {"shirting", 1500.0, 1500.0, 60.0, 9e-6, 0.115},
                                         {"silk", 1000.0, 1000.0, 30.0, 1.3e-6, 0.08},
                                         {"stretch_jersey", 80.0, 120.0, 40.0, 3e-6, 0.22},
                                         {"wool", 1700.0, 2100.0, 52.0, 6e-6, 0.17}}};

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
