// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/panel_boundary.h"

#include <cmath>

#include "engine/core/error.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/disjoint_sets.h"
#include "engine/geometry/self_crossing.h"

namespace toile {

namespace {

constexpr double kTouch = 1e-9;       // m; chords nearer than this count as crossing
constexpr int kMostRefinements = 10;  // doublings: a thousandth of the target length

// Per corner the number of its cluster of collapsed edges, and the clusters' middles.
struct CornerClusters {
  std::vector<int> of_corner;
  std::vector<Vec2> middle;

  CornerClusters(const Panel& panel, const std::vector<EdgeSamples>& samples) {
    const int n = panel.edge_count();
    DisjointSets sets(n);
    for (int e = 0; e < n; ++e)
      if (samples[static_cast<std::size_t>(e)].collapsed) sets.join(e, (e + 1) % n);
    int count = 0;
    std::tie(of_corner, count) = sets.numbering();
    middle.assign(static_cast<std::size_t>(count), Vec2::Zero());
    std::vector<int> members(static_cast<std::size_t>(count), 0);
    for (std::size_t c = 0; c < of_corner.size(); ++c) {
      const auto cluster = static_cast<std::size_t>(of_corner[c]);
      middle[cluster] += panel.corners[c];
      ++members[cluster];
    }
    for (std::size_t c = 0; c < middle.size(); ++c) middle[c] /= members[c];
  }
};

double polygon_area(const std::vector<Vec2>& points) {
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &p = points[i], &q = points[(i + 1) % points.size()];
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return area;
}

}  // namespace

PanelBoundary sample_boundary(const Pattern& pattern, PanelId id, const EdgeSampling& sampling) {
  const Panel& panel = pattern.panel(id);
  const int n = panel.edge_count();
  PanelBoundary boundary;
  for (int e = 0; e < n; ++e) boundary.samples.push_back(sampling.samples(id, e));
  const CornerClusters clusters(panel, boundary.samples);
  std::vector<int> vertex_of_cluster(clusters.middle.size(), -1);
  const auto cluster_of = [&](int corner) {
    return static_cast<std::size_t>(clusters.of_corner[static_cast<std::size_t>(corner % n)]);
  };
  boundary.edge_vertices.resize(static_cast<std::size_t>(n));
  for (int e = 0; e < n; ++e) {
    const EdgeSamples& samples = boundary.samples[static_cast<std::size_t>(e)];
    if (samples.collapsed) continue;
    const std::vector<Vec2> points = curve_points_at(edge_curve(panel, e), samples.fractions);
    auto& vertices = boundary.edge_vertices[static_cast<std::size_t>(e)];
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      vertices.push_back(static_cast<int>(boundary.points.size()));
      boundary.points.push_back(i == 0 ? clusters.middle[cluster_of(e)] : points[i]);
      boundary.edge_of_segment.push_back(e);
    }
    vertex_of_cluster[cluster_of(e)] = vertices.front();
  }
  for (int e = 0; e < n; ++e)
    boundary.edge_vertices[static_cast<std::size_t>(e)].push_back(vertex_of_cluster[cluster_of(e + 1)]);
  boundary.signed_area = polygon_area(boundary.points);
  return boundary;
}

namespace {

// The two edges of a panel whose chords cross, if any.
std::optional<std::pair<int, int>> crossed_edges(const Panel& panel, const PanelBoundary& boundary) {
  if (const auto crossing = find_self_crossing(boundary.points, kTouch))
    return std::pair(boundary.edge_of_segment[static_cast<std::size_t>(crossing->first)],
                     boundary.edge_of_segment[static_cast<std::size_t>(crossing->second)]);
  // Turned over by coarse sampling: refine where most is lost, at the first and last edge.
  if (boundary.signed_area * outline_signed_area(panel) <= 0) return std::pair(0, panel.edge_count() - 1);
  return std::nullopt;
}

}  // namespace

std::vector<PanelBoundary> sample_boundaries(const Pattern& pattern, EdgeSampling& sampling) {
  for (int round = 0;; ++round) {
    std::vector<PanelBoundary> boundaries;
    bool crossed = false;
    for (int p = 0; p < static_cast<int>(pattern.panels.size()); ++p) {
      const Panel& panel = pattern.panels[static_cast<std::size_t>(p)];
      boundaries.push_back(sample_boundary(pattern, PanelId(p), sampling));
      const auto edges = crossed_edges(panel, boundaries.back());
      if (!edges) continue;
      if (round == kMostRefinements)
        throw Error(ErrorCode::GarmentInvalid, "panel:" + panel.name,
                    "panel \"" + panel.name + "\" is too thin to be meshed between edge " +
                        std::to_string(edges->first) + " and edge " + std::to_string(edges->second) +
                        "; widen it there or ask for more triangles");
      crossed = true;
      for (int e = 0; e < panel.edge_count(); ++e)
        if (e == edges->first || e == edges->second || sampling.segment_count(PanelId(p), e) == 0)
          sampling.refine(PanelId(p), e);
    }
    if (!crossed) return boundaries;
  }
}

}  // namespace toile
