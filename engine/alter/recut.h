// SPDX-License-Identifier: GPL-3.0-or-later
// What a torn sheet leaves uncovered of the wanted panel: the cloth to add (or, with the roles swapped, to take away),
// and what is kept. Exact polygon booleans; nothing is left between cloth and a side it hangs on.
// Source: [Eggler2024, Sec. 6.3 end].  Lengths in metres.
#pragma once

#include "engine/alter/sheet.h"
#include "engine/geometry/polygon_boolean.h"

namespace toile {

struct RecutOptions {
  bool l_shapes = false;          // leave L- and T-shaped openings in one piece; else they become strips
  double least_area = 2e-4;       // m^2: smaller openings are eased in instead of cut                [method, Sec. 5]
  double least_width = 0.004;     // m, mean: narrower ones too
  double least_strip = 0.0;       // m: where a side is let go by more than ...
  std::vector<double> side_room;  // ... its turned-in cloth gives (m, per side), the cloth is cut back until a circle
                                  // of this width lies in every strip that is let in there; empty: never
  Loops wedges;                   // darts and slits of the wanted panel, which part what is open across their mouths
};

struct RecutPanel {
  std::vector<Vec2> wanted;                // outline of the wanted panel, counter-clockwise
  std::vector<std::vector<Vec2>> kept;     // outlines of the cloth where the wanted panel has it
  std::vector<PolygonWithHoles> openings;  // wanted minus kept and wedges, true to scale in the wanted panel
  double cut_back = 0.0;                   // m^2, of cloth that gives way to strips of the least width
  int dropped = 0;                         // openings too small to sew
};

RecutPanel recut(const Sheet& sheet, const RecutOptions& options = {});

}  // namespace toile
