// SPDX-License-Identifier: GPL-3.0-or-later
// The sampled outline of one panel: a loop of vertices, and which of them lie on which edge.
#pragma once

#include <vector>

#include "engine/core/pattern.h"
#include "engine/stages/edge_sampling.h"

namespace toile {

struct PanelBoundary {
  std::vector<Vec2> points;                     // in the order of the panel's edges, m
  std::vector<std::vector<int>> edge_vertices;  // per edge, from its start to its end; one vertex if collapsed
  std::vector<int> edge_of_segment;             // segment i runs from point i to point i + 1
  std::vector<EdgeSamples> samples;             // per edge
  double signed_area = 0.0;                     // of the polygon; > 0: counter-clockwise
};

// Collapsed edges become one vertex in the middle of the corners they join.
PanelBoundary sample_boundary(const Pattern& pattern, PanelId panel, const EdgeSampling& sampling);

// Boundaries of all panels. Refines `sampling` until every one of them is free of self-crossings.
// Throws Error{GarmentInvalid} for a panel that stays crossed however fine it is sampled.
std::vector<PanelBoundary> sample_boundaries(const Pattern& pattern, EdgeSampling& sampling);

}  // namespace toile
