// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/outline_crossing.h"

#include "engine/geometry/curve.h"
#include "engine/geometry/self_crossing.h"

namespace toile {
namespace {

constexpr double kTouchTolerance = 1e-7;    // m; closer than this two parts of an outline count as touching
constexpr double kFlattenTolerance = 2e-5;  // m; chords against curves in the crossing test
constexpr int kMostChordsPerEdge = 256;

}  // namespace

std::optional<OutlineCrossing> find_outline_crossing(const Panel& panel) {
  std::vector<Vec2> polygon;
  std::vector<int> edge_of_segment;
  for (int e = 0; e < panel.edge_count(); ++e) {
    std::vector<Vec2> points = flatten_curve(edge_curve(panel, e), kFlattenTolerance);
    if (points.size() > kMostChordsPerEdge &&
        panel.edges[static_cast<std::size_t>(e)].curve.kind != CurveKind::Polyline)
      points = sample_curve(edge_curve(panel, e), kMostChordsPerEdge);
    polygon.insert(polygon.end(), points.begin(), points.end() - 1);
    edge_of_segment.resize(polygon.size(), e);
  }
  const auto crossing = find_self_crossing(polygon, kTouchTolerance);
  if (!crossing) return std::nullopt;
  return OutlineCrossing{edge_of_segment[static_cast<std::size_t>(crossing->first)],
                         edge_of_segment[static_cast<std::size_t>(crossing->second)],
                         polygon[static_cast<std::size_t>(crossing->first)]};
}

}  // namespace toile
