// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/panel_tracks.h"

#include <algorithm>
#include <limits>

namespace toile {
namespace {

constexpr double kOnEdge = 2e-4;  // m

struct LinePlace {
  double distance = std::numeric_limits<double>::infinity();
  double at = 0.0;       // number of the point and share of the way to the next
  bool on_left = false;  // of the nearest segment
};

LinePlace place_on(const std::vector<Vec2>& line, const Vec2& p) {
  LinePlace best;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 way = line[i + 1] - line[i], offset = p - line[i];
    const double squared = way.squaredNorm();
    const double t = squared > 0 ? std::clamp(offset.dot(way) / squared, 0.0, 1.0) : 0.0;
    const double distance = (offset - t * way).norm();
    if (distance < best.distance)
      best = {distance, static_cast<double>(i) + t, way.x() * offset.y() - way.y() * offset.x() > 0};
  }
  return best;
}

}  // namespace

PanelTracks::PanelTracks(const PatternMesh& mesh, const Points2& target_rest, int panel) {
  for (const std::vector<int>& vertices : mesh.edge_vertices[static_cast<std::size_t>(panel)]) {
    edges_.emplace_back();
    if (vertices.size() > 1)
      for (const int v : vertices) edges_.back().emplace_back(target_rest.row(v));
  }
}

bool PanelTracks::along_edge_within(const Vec2& a, const Vec2& b, double reach, RegionBorder& border) const {
  double nearest = reach;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const LinePlace middle = place_on(edges_[e], 0.5 * (a + b));
    if (middle.distance >= nearest) continue;
    nearest = middle.distance;
    border.track = {static_cast<int>(e), -1, false};
    border.at_from = place_on(edges_[e], a).at;
    border.at_to = place_on(edges_[e], b).at;
  }
  return nearest < reach;
}

bool PanelTracks::along_edge(const Vec2& a, const Vec2& b, RegionBorder& border) const {
  return along_edge_within(a, b, kOnEdge, border);
}

void PanelTracks::nearest_edge(const Vec2& a, const Vec2& b, RegionBorder& border) const {
  along_edge_within(a, b, std::numeric_limits<double>::infinity(), border);
}

bool PanelTracks::along_cut(const Sheet& sheet, std::size_t cut, const Vec2& a, const Vec2& b, double reach,
                            RegionBorder& border) const {
  std::vector<Vec2> path;
  std::vector<double> length;
  for (const auto& lips : sheet.cuts[cut].lips) {
    const Vec2& p = sheet.vertices[static_cast<std::size_t>(lips.first)].flat;
    length.push_back(path.empty() ? 0.0 : length.back() + (p - path.back()).norm());
    path.push_back(p);
  }
  const LinePlace middle = place_on(path, 0.5 * (a + b));
  if (middle.distance > reach) return false;
  const auto arc = [&](const Vec2& p) {
    const double at = place_on(path, p).at;
    const auto i = std::min(static_cast<std::size_t>(at), path.size() - 2);
    return length[i] + (at - static_cast<double>(i)) * (length[i + 1] - length[i]);
  };
  border.track = {-1, static_cast<int>(cut), middle.on_left};
  border.at_from = arc(a);
  border.at_to = arc(b);
  return true;
}

}  // namespace toile
