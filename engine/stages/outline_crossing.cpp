// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/outline_crossing.h"

#include <algorithm>

#include "engine/geometry/curve.h"
#include "engine/geometry/self_crossing.h"

namespace toile {
namespace {

constexpr double kTouchTolerance = 1e-7;    // m; closer than this two parts of an outline count as touching
constexpr double kFlattenTolerance = 2e-5;  // m; chords against curves in the crossing test
// The most intricate of twenty-two real garments needs 1,400 chords and 4,500 comparisons.
constexpr int kMostChords = 100'000;
constexpr int kFewestChordsPerEdge = 8, kMostChordsPerEdge = 256;

}  // namespace

CrossingWork crossing_work(const Pattern& pattern) {
  int edges = 1;
  for (const Panel& panel : pattern.panels) edges += panel.edge_count();
  CrossingWork work;
  work.chords_per_edge = std::clamp(kMostChords / edges, kFewestChordsPerEdge, kMostChordsPerEdge);
  return work;
}

std::optional<OutlineCrossing> find_outline_crossing(const Panel& panel, CrossingWork& work) {
  std::vector<Vec2> polygon;
  std::vector<int> edge_of_segment;
  for (int e = 0; e < panel.edge_count(); ++e) {
    const std::vector<Vec2> points = flatten_curve(edge_curve(panel, e), kFlattenTolerance, work.chords_per_edge);
    polygon.insert(polygon.end(), points.begin(), points.end() - 1);
    edge_of_segment.resize(polygon.size(), e);
  }
  const auto crossing = find_self_crossing(polygon, kTouchTolerance, &work.comparisons_left);
  if (!crossing) return std::nullopt;
  return OutlineCrossing{edge_of_segment[static_cast<std::size_t>(crossing->first)],
                         edge_of_segment[static_cast<std::size_t>(crossing->second)],
                         polygon[static_cast<std::size_t>(crossing->first)]};
}

}  // namespace toile
