// SPDX-License-Identifier: GPL-3.0-or-later
// What is open between cloth and wanted outline, as pieces that can be sewn: parted where the cloth comes near the
// outline, and an L or a T as strips, of which none is a crumb. Used by recut only.   Lengths in metres.
#pragma once

#include "engine/geometry/polygon_boolean.h"

namespace toile {

struct PartOpeningOptions {
  double least_area = 2e-4;    // m^2: smaller openings are eased in instead of cut                [method, Sec. 5]
  double least_width = 0.004;  // m: narrower places part an opening; openings of less mean width are eased in
  double least_strip = 0.0;    // m: a strip of an L that is narrower all along stays with its neighbour
  bool l_shapes = false;       // leave L- and T-shaped openings in one piece
};

// An opening parted at its necks: places narrower than `least_width` with enough on either side. There the parts end in
// one point, on the outline `wanted` where it is one of the neck's borders, so that kept cloth reaches the outline.
std::vector<std::vector<Vec2>> parted_at_necks(const std::vector<Vec2>& opening, const std::vector<Vec2>& wanted,
                                               const PartOpeningOptions& options);

bool worth_sewing(const std::vector<Vec2>& opening, const PartOpeningOptions& options);

// Strips of an opening, or the opening itself.
std::vector<std::vector<Vec2>> strips_of(const std::vector<Vec2>& opening, const PartOpeningOptions& options);

}  // namespace toile
