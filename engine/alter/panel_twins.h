// SPDX-License-Identifier: GPL-3.0-or-later
// Which panels are each other's mirror image on the wearer, side by side: what a tailor does on the left is done on the
// right.   Source: [Eggler2024, Sec. 8 "Managing symmetry"].  Lengths in metres.
#pragma once

#include <optional>
#include <vector>

#include "engine/alter/sheet.h"

namespace toile {

struct PanelTwin {
  int panel = -1;                      // the mirror image; a panel on the wearer's mid plane is its own
  std::vector<int> side_of;            // side of the twin for every side of this panel, run through the other way
  Mat2 reflection = Mat2::Identity();  // takes directions in this panel's cloth to the twin's
};

// Per panel its twin, if it has one. Sides of twins agree in length within 2 mm and 1 %, corners after reflection
// within 1 cm; the twin stands opposite across the symmetry plane of the pattern within 3 cm.
std::vector<std::optional<PanelTwin>> find_panel_twins(const Pattern& pattern, const std::vector<Sheet>& sheets);

}  // namespace toile
