// SPDX-License-Identifier: GPL-3.0-or-later
// Panels that are not altered but cut anew to the target: no tears bring them near it, or the altered pieces could not
// be sewn. Out of the panel's own cloth where the target lies inside it with the grain kept, else out of new cloth.
// Lengths in metres.
#pragma once

#include <map>
#include <optional>

#include "engine/core/pattern.h"
#include "engine/geometry/place_polygon.h"

namespace toile {

struct PanelAlteration;

struct CutAnew {
  std::string why;
  std::optional<PolygonPlace> in_own_cloth;  // from the target panel's frame to the original's; nothing: new cloth
  int mirror = -1;                           // panel that is its mirror image: left and right are one operation
};

// By panel.
using RecutPanels = std::map<int, CutAnew>;

// Why no tears alter the panel, or empty: what they leave is over twice the allowed stretch, or kept cloth overlaps.
std::string hopeless(const PanelAlteration& panel, double stretch_limit);

// Where `target` (with its darts filled) lies in the cloth of the original panel, half a turn only where nothing else
// fits. Equal allowances need no room of their own; where they differ, a turned piece keeps that far off the outline.
std::optional<PolygonPlace> place_in_own_cloth(const Panel& panel, double seam_allowance,
                                               const std::vector<Vec2>& original, const std::vector<Vec2>& target);

}  // namespace toile
