// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/mesh_panel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "engine/geometry/self_crossing.h"

namespace toile {

namespace {

constexpr double kSameFraction = 1e-9;
constexpr double kTouch = 1e-9;  // m

// Per boundary vertex of `source` the vertex of `image` that mirrors it; empty if their samples differ.
std::vector<int> mirrored_vertices(const PanelBoundary& source, const PanelBoundary& image, const PanelMirror& mirror) {
  std::vector<int> vertex(source.points.size(), -1);
  for (std::size_t e = 0; e < source.samples.size(); ++e) {
    const auto f = static_cast<std::size_t>(mirror.edge_of[e]);
    const auto &a = source.samples[e], &b = image.samples[f];
    const auto &from = source.edge_vertices[e], &to = image.edge_vertices[f];
    if (a.collapsed != b.collapsed || from.size() != to.size()) return {};
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t j = from.size() - 1 - i;
      if (!a.collapsed && std::abs(a.fractions[i] + b.fractions[j] - 1.0) > kSameFraction) return {};
      int& known = vertex[static_cast<std::size_t>(from[i])];
      if (known >= 0 && known != to[j]) return {};
      known = to[j];
    }
  }
  return vertex;
}

// The loop to hand to the mesher, counter-clockwise, as numbers into the boundary's points.
std::vector<int> counter_clockwise_loop(std::vector<int> loop, double signed_area) {
  if (signed_area < 0) std::reverse(loop.begin(), loop.end());
  return loop;
}

std::vector<Vec2> points_of(const std::vector<Vec2>& points, const std::vector<int>& loop) {
  std::vector<Vec2> polygon;
  for (const int v : loop) polygon.push_back(points[static_cast<std::size_t>(v)]);
  return polygon;
}

// Appends triangles with every corner renamed; `flip` keeps them counter-clockwise through a reflection.
void append_triangles(Triangles& to, const Triangles& from, const std::vector<int>& name, bool flip) {
  const Eigen::Index first = to.rows();
  to.conservativeResize(first + from.rows(), 3);
  for (Eigen::Index f = 0; f < from.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int corner = flip ? (3 - k) % 3 : k;
      to(first + f, k) = name[static_cast<std::size_t>(from(f, corner))];
    }
}

using EdgeUses = std::map<std::pair<int, int>, std::vector<std::pair<int, int>>>;

// Inner edges between vertices that are sewn into one, each with its two triangles and the corner it starts at.
EdgeUses find_pinched_edges(const PolygonMesh& mesh, const std::vector<int>& sewn_as) {
  const int boundary = static_cast<int>(sewn_as.size());
  EdgeUses pinched;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
      if (a < boundary && b < boundary && sewn_as[static_cast<std::size_t>(a)] == sewn_as[static_cast<std::size_t>(b)])
        pinched[std::minmax(a, b)].emplace_back(static_cast<int>(f), k);
    }
  std::erase_if(pinched, [](const auto& entry) { return entry.second.size() != 2; });
  return pinched;
}

}  // namespace

PolygonMesh mesh_panel(const PanelBoundary& boundary, double edge_length) {
  std::vector<int> loop(boundary.points.size());
  std::iota(loop.begin(), loop.end(), 0);
  loop = counter_clockwise_loop(std::move(loop), boundary.signed_area);
  const PolygonMesh inner = mesh_polygon(points_of(boundary.points, loop), edge_length);
  PolygonMesh mesh;
  mesh.points = boundary.points;
  mesh.points.insert(mesh.points.end(), inner.points.begin() + static_cast<std::ptrdiff_t>(loop.size()),
                     inner.points.end());
  for (std::size_t v = loop.size(); v < inner.points.size(); ++v) loop.push_back(static_cast<int>(v));
  append_triangles(mesh.triangles, inner.triangles, loop, false);
  return mesh;
}

std::optional<PolygonMesh> mesh_symmetric_panel(const PanelBoundary& boundary, const PanelMirror& mirror,
                                                double edge_length) {
  const std::vector<int> image = mirrored_vertices(boundary, boundary, mirror);
  const int n = static_cast<int>(boundary.points.size());
  std::vector<int> on_axis;
  for (int v = 0; v < static_cast<int>(image.size()); ++v)
    if (image[static_cast<std::size_t>(v)] == v) on_axis.push_back(v);
  if (on_axis.size() != 2) return std::nullopt;

  // One half of the loop, closed by points along the axis, which are numbered after the boundary.
  std::vector<Vec2> points = boundary.points;
  std::vector<int> loop;
  for (int v = on_axis[0]; v <= on_axis[1]; ++v) loop.push_back(v);
  const Vec2 from = points[static_cast<std::size_t>(on_axis[1])], to = points[static_cast<std::size_t>(on_axis[0])];
  const int steps = std::max(1, static_cast<int>(std::lround((to - from).norm() / edge_length)));
  for (int i = 1; i < steps; ++i) {
    loop.push_back(static_cast<int>(points.size()));
    points.push_back(from + (static_cast<double>(i) / steps) * (to - from));
  }
  if (loop.size() < 3) return std::nullopt;
  loop = counter_clockwise_loop(std::move(loop), boundary.signed_area);
  const std::vector<Vec2> half_polygon = points_of(points, loop);
  if (find_self_crossing(half_polygon, kTouch)) return std::nullopt;

  const PolygonMesh half = mesh_polygon(half_polygon, edge_length);
  std::vector<int> reflected = loop;
  for (int& v : reflected)
    if (v < n) v = image[static_cast<std::size_t>(v)];
  PolygonMesh mesh;
  mesh.points = std::move(points);
  for (std::size_t v = loop.size(); v < half.points.size(); ++v) {
    const int first = static_cast<int>(mesh.points.size());
    mesh.points.push_back(half.points[v]);
    mesh.points.push_back(mirror.reflection * half.points[v] + mirror.offset);
    loop.push_back(first);
    reflected.push_back(first + 1);
  }
  append_triangles(mesh.triangles, half.triangles, loop, false);
  append_triangles(mesh.triangles, half.triangles, reflected, true);
  return mesh;
}

std::optional<PolygonMesh> mirrored_mesh(const PanelBoundary& boundary, const PanelMirror& mirror,
                                         const PanelBoundary& source_boundary, const PolygonMesh& source_mesh) {
  std::vector<int> name = mirrored_vertices(source_boundary, boundary, mirror);
  if (name.empty() || source_boundary.points.size() != boundary.points.size()) return std::nullopt;
  PolygonMesh mesh;
  mesh.points = boundary.points;
  for (std::size_t v = boundary.points.size(); v < source_mesh.points.size(); ++v) {
    name.push_back(static_cast<int>(v));
    mesh.points.push_back(mirror.reflection * source_mesh.points[v] + mirror.offset);
  }
  append_triangles(mesh.triangles, source_mesh.triangles, name, true);
  return mesh;
}

void split_pinched_edges(PolygonMesh& mesh, const std::vector<int>& sewn_as) {
  // A triangle is split once a pass; a second pinched edge of it waits for the next pass.
  for (EdgeUses pinched = find_pinched_edges(mesh, sewn_as); !pinched.empty();
       pinched = find_pinched_edges(mesh, sewn_as)) {
    std::set<int> split;
    for (const auto& [edge, uses] : pinched) {
      if (split.contains(uses[0].first) || split.contains(uses[1].first)) continue;
      const int middle = static_cast<int>(mesh.points.size());
      mesh.points.push_back(0.5 * (mesh.points[static_cast<std::size_t>(edge.first)] +
                                   mesh.points[static_cast<std::size_t>(edge.second)]));
      for (const auto& [f, k] : uses) {
        const int b = mesh.triangles(f, (k + 1) % 3), c = mesh.triangles(f, (k + 2) % 3);
        mesh.triangles(f, (k + 1) % 3) = middle;
        mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
        mesh.triangles.bottomRows(1) << middle, b, c;
        split.insert(f);
      }
    }
  }
}

}  // namespace toile
