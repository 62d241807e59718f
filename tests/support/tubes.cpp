// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/tubes.h"

#include <cmath>
#include <numbers>

#include "tests/support/rectangles.h"

namespace toile::test {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// Vertices of panel edge e (0 bottom, 1 right, 2 top, 3 left) of a grid whose lower left vertex is `first`.
std::vector<int> grid_edge(int e, int first, int columns, int rows) {
  std::vector<int> vertices;
  const int width = columns + 1;
  if (e == 0)
    for (int i = 0; i <= columns; ++i) vertices.push_back(first + i);
  if (e == 1)
    for (int j = 0; j <= rows; ++j) vertices.push_back(first + j * width + columns);
  if (e == 2)
    for (int i = columns; i >= 0; --i) vertices.push_back(first + rows * width + i);
  if (e == 3)
    for (int j = rows; j >= 0; --j) vertices.push_back(first + j * width);
  return vertices;
}

void add_cell(PatternMesh& mesh, int& triangle, int lower_left, int width, bool flip) {
  const int a = lower_left, b = a + 1, c = a + width + 1, d = a + width;
  if (flip) {
    mesh.triangles.row(triangle++) << a, b, d;
    mesh.triangles.row(triangle++) << b, c, d;
  } else {
    mesh.triangles.row(triangle++) << a, b, c;
    mesh.triangles.row(triangle++) << a, c, d;
  }
}

}  // namespace

Body tube_body(const std::string& name, const RadiusOfHeight& radius, double height, int around, int rings) {
  Body body;
  body.name = name;
  body.kind = BodyKind::Form;
  Points3& v = body.surface.vertices;
  v.resize((rings + 1) * around + 2, 3);
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double y = height * i / rings, angle = kTwoPi * j / around, r = radius(y);
      v.row(i * around + j) << r * std::sin(angle), y, r * std::cos(angle);
    }
  const int bottom = (rings + 1) * around, top = bottom + 1;
  v.row(bottom).setZero();
  v.row(top) << 0, height, 0;
  Triangles& t = body.surface.triangles;
  t.resize(2 * rings * around + 2 * around, 3);
  int f = 0;
  for (int j = 0; j < around; ++j) {
    const int k = (j + 1) % around;
    for (int i = 0; i < rings; ++i) {
      const int a = i * around + j, b = i * around + k, c = b + around, d = a + around;
      t.row(f++) << a, b, c;
      t.row(f++) << a, c, d;
    }
    t.row(f++) << bottom, k, j;
    t.row(f++) << top, rings * around + j, rings * around + k;
  }
  return body;
}

Body tube_body(const std::string& name, double radius, double height, int around, int rings) {
  return tube_body(
      name, [radius](double) { return radius; }, height, around, rings);
}

Pattern tube_skirt_pattern(double girth, double height, double bottom_y, double distance) {
  Pattern pattern;
  pattern.name = "tube_skirt";
  const double width = girth / 2;
  Panel front = rectangle("front", width, height), back = rectangle("back", width, height);
  front.translation = Vec3(-width / 2, bottom_y, distance);
  back.rotation = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()).toRotationMatrix();
  back.translation = Vec3(width / 2, bottom_y, -distance);
  front.edges[2].label = back.edges[2].label = "lower_interface";
  pattern.panels = {front, back};
  pattern.seams = {{{PanelId(0), 1}, {PanelId(1), 3}, false}, {{PanelId(0), 3}, {PanelId(1), 1}, false}};
  return pattern;
}

Pattern sheet_pattern(double width, double height, double top_y) {
  Pattern pattern;
  pattern.name = "sheet";
  pattern.panels = {rectangle("sheet", width, height)};
  pattern.panels[0].translation = Vec3(-width / 2, top_y - height, 0);
  return pattern;
}

PatternMesh structured_mesh(const Pattern& rectangles, int columns, int rows) {
  PatternMesh mesh;
  const int panels = static_cast<int>(rectangles.panels.size()), width = columns + 1;
  const int per_panel = width * (rows + 1), cells = columns * rows;
  mesh.rest.resize(panels * per_panel, 2);
  mesh.triangles.resize(panels * 2 * cells, 3);
  int triangle = 0;
  for (int p = 0; p < panels; ++p) {
    const Panel& panel = rectangles.panels[static_cast<std::size_t>(p)];
    const Vec2 low = panel.corners[0], size = panel.corners[2] - low;
    const int first = p * per_panel;
    mesh.panels.push_back({first, first + per_panel, triangle, triangle + 2 * cells});
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i)
        mesh.rest.row(first + j * width + i) << low.x() + size.x() * i / columns, low.y() + size.y() * j / rows;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) add_cell(mesh, triangle, first + j * width + i, width, (i + j) % 2 == 1);
    mesh.edge_vertices.emplace_back();
    for (int e = 0; e < 4; ++e) mesh.edge_vertices.back().push_back(grid_edge(e, first, columns, rows));
    mesh.panel_of_vertex.insert(mesh.panel_of_vertex.end(), static_cast<std::size_t>(per_panel), p);
    mesh.panel_of_triangle.insert(mesh.panel_of_triangle.end(), static_cast<std::size_t>(2 * cells), p);
    mesh.panel_reversed.push_back(false);
  }
  for (const Seam& seam : rectangles.seams) {
    const auto side = [&](const SeamSide& s) -> const std::vector<int>& {
      return mesh.edge_vertices[static_cast<std::size_t>(s.panel.value)][static_cast<std::size_t>(s.edge)];
    };
    const auto &a = side(seam.a), &b = side(seam.b);
    mesh.seam_vertices.emplace_back();
    for (std::size_t i = 0; i < a.size(); ++i)
      mesh.seam_vertices.back().emplace_back(a[i], seam.right_wrong ? b[i] : b[b.size() - 1 - i]);
  }
  weld_seams(mesh);
  const Panel& first = rectangles.panels[0];
  mesh.target_edge_length = (first.corners[2] - first.corners[0]).cwiseQuotient(Vec2(columns, rows)).mean();
  return mesh;
}

Points3 placed_nodes(const Pattern& pattern, const PatternMesh& mesh) {
  Points3 nodes = Points3::Zero(mesh.node_count, 3);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(mesh.node_count);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(mesh.panel_of_vertex[static_cast<std::size_t>(v)])];
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    const Vec3 flat(mesh.rest(v, 0), mesh.rest(v, 1), 0);
    nodes.row(node) += (panel.rotation * flat + panel.translation).transpose();
    count[node] += 1;
  }
  return nodes.array().colwise() / count.array();
}

Drape wrapped_tube(const Pattern& tube, const PatternMesh& mesh, const RadiusOfHeight& radius, double bottom_y,
                   double stretch_y) {
  Drape drape{Points3(mesh.node_count, 3)};
  const double half_turn = kTwoPi / 2;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const int panel = mesh.panel_of_vertex[static_cast<std::size_t>(v)];
    const double width = tube.panels[static_cast<std::size_t>(panel)].corners[1].x();
    // Middle of the front at angle 0 (+z), angles growing towards +x; the back follows half a turn later.
    const double angle = half_turn * (mesh.rest(v, 0) / width - 0.5) + (panel == 1 ? half_turn : 0.0);
    const double y = bottom_y + stretch_y * mesh.rest(v, 1), r = radius(y);
    drape.nodes.row(mesh.node_of_vertex[static_cast<std::size_t>(v)]) << r * std::sin(angle), y, r * std::cos(angle);
  }
  return drape;
}

}  // namespace toile::test
