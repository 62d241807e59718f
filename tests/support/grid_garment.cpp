// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/grid_garment.h"

#include <random>

#include "tests/support/rectangles.h"

namespace toile::test {
namespace {

void add_triangles(const GridPanel& panel, int first_vertex, std::vector<Eigen::Vector3i>& triangles) {
  const auto at = [&](int i, int j) { return first_vertex + j * (panel.columns + 1) + i; };
  for (int j = 0; j < panel.rows; ++j)
    for (int i = 0; i < panel.columns; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2 == 0) {
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(a, c, d);
      } else {
        triangles.emplace_back(a, b, d);
        triangles.emplace_back(b, c, d);
      }
    }
}

std::vector<std::vector<int>> edge_loops(const GridPanel& panel, int first) {
  const int n = panel.columns, m = panel.rows;
  const auto at = [&](int i, int j) { return first + j * (n + 1) + i; };
  std::vector<std::vector<int>> edges(4);
  for (int i = 0; i <= n; ++i) edges[0].push_back(at(i, 0));
  for (int j = 0; j <= m; ++j) edges[1].push_back(at(n, j));
  for (int i = n; i >= 0; --i) edges[2].push_back(at(i, m));
  for (int j = m; j >= 0; --j) edges[3].push_back(at(0, j));
  return edges;
}

}  // namespace

GridGarment grid_garment(const std::vector<GridPanel>& panels, const std::vector<GridSeam>& seams) {
  GridGarment garment;
  PatternMesh& mesh = garment.mesh;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<Vec2> positions;
  std::mt19937 random(7);
  for (const GridPanel& panel : panels) {
    PanelRange range;
    range.vertex_begin = static_cast<int>(positions.size());
    range.triangle_begin = static_cast<int>(triangles.size());
    const Vec2 cell(panel.width / panel.columns, panel.height / panel.rows);
    std::uniform_real_distribution<double> shift(-panel.jitter, panel.jitter);
    for (int j = 0; j <= panel.rows; ++j)
      for (int i = 0; i <= panel.columns; ++i) {
        const bool inner = i > 0 && j > 0 && i < panel.columns && j < panel.rows;
        const double x = i + (inner ? shift(random) : 0.0), y = j + (inner ? shift(random) : 0.0);
        positions.emplace_back(x * cell.x(), y * cell.y());
      }
    add_triangles(panel, range.vertex_begin, triangles);
    range.vertex_end = static_cast<int>(positions.size());
    range.triangle_end = static_cast<int>(triangles.size());
    const int number = static_cast<int>(mesh.panels.size());
    mesh.panel_of_vertex.resize(positions.size(), number);
    mesh.panel_of_triangle.resize(triangles.size(), number);
    mesh.panels.push_back(range);
    mesh.panel_reversed.push_back(false);
    mesh.edge_vertices.push_back(edge_loops(panel, range.vertex_begin));
    mesh.target_edge_length = std::max(mesh.target_edge_length, cell.maxCoeff());
    garment.pattern.panels.push_back(rectangle(panel.name, panel.width, panel.height));
  }
  mesh.rest.resize(static_cast<int>(positions.size()), 2);
  for (int v = 0; v < mesh.vertex_count(); ++v) mesh.rest.row(v) = positions[static_cast<std::size_t>(v)];
  mesh.triangles.resize(static_cast<int>(triangles.size()), 3);
  for (int f = 0; f < mesh.triangle_count(); ++f) mesh.triangles.row(f) = triangles[static_cast<std::size_t>(f)];
  for (const GridSeam& seam : seams) {
    garment.pattern.seams.push_back(
        {{PanelId(seam.panel_a), seam.edge_a}, {PanelId(seam.panel_b), seam.edge_b}, false});
    const auto& a = mesh.edge_vertices[static_cast<std::size_t>(seam.panel_a)][static_cast<std::size_t>(seam.edge_a)];
    const auto& b = mesh.edge_vertices[static_cast<std::size_t>(seam.panel_b)][static_cast<std::size_t>(seam.edge_b)];
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t i = 0; i < a.size(); ++i) pairs.emplace_back(a[i], b[b.size() - 1 - i]);
    mesh.seam_vertices.push_back(pairs);
  }
  weld_seams(mesh);
  return garment;
}

Points2 GridGarment::mapped(const std::function<Vec2(int, const Vec2&)>& map) const {
  Points2 result(mesh.vertex_count(), 2);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    result.row(v) = map(mesh.panel_of_vertex[static_cast<std::size_t>(v)], mesh.rest.row(v).transpose());
  return result;
}

}  // namespace toile::test
