// SPDX-License-Identifier: GPL-3.0-or-later
// Which panels are mirror images of each other, or of themselves.
//
// Two outlines mirror each other when a reflection of the plane takes every edge of one, walked backwards, onto an edge
// of the other within 1 micrometre. Of several reflections the one nearest to x -> -x is taken. Lengths in metres.
#pragma once

#include <optional>
#include <vector>

#include "engine/core/pattern.h"

namespace toile {

struct PanelMirror {
  PanelId source;            // p_this = reflection * p_source + offset
  std::vector<int> edge_of;  // edge of this panel for every edge of `source`, walked the other way
  Mat2 reflection = Mat2::Identity();
  Vec2 offset = Vec2::Zero();
};

struct PanelMirrors {
  std::vector<std::optional<PanelMirror>> self;  // per panel: its own mirror axis
  // Per panel: the earlier panels that it mirrors; first the one that stands opposite across x = 0 as placed.
  std::vector<std::vector<PanelMirror>> pairs;
};

PanelMirrors find_panel_mirrors(const Pattern& pattern);

}  // namespace toile
