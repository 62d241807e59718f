// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/mesh_panels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "engine/geometry/curve.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/panel_mirrors.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

constexpr double kLeastTriangleArea = 1e-9;  // m^2, the contract of mesh_panels

Panel polygon_panel(const std::string& name, std::vector<Vec2> corners) {
  Panel panel;
  panel.name = name;
  panel.edges.resize(corners.size());
  panel.corners = std::move(corners);
  return panel;
}

double area_of(const PatternMesh& mesh, int f) {
  const Vec2 a = mesh.rest.row(mesh.triangles(f, 0)), b = mesh.rest.row(mesh.triangles(f, 1)),
             c = mesh.rest.row(mesh.triangles(f, 2));
  return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

double least_angle_degrees(const PatternMesh& mesh, int f) {
  double least = 180.0;
  for (int k = 0; k < 3; ++k) {
    const Vec2 p = mesh.rest.row(mesh.triangles(f, k));
    const Vec2 u = mesh.rest.row(mesh.triangles(f, (k + 1) % 3)).transpose() - p;
    const Vec2 w = mesh.rest.row(mesh.triangles(f, (k + 2) % 3)).transpose() - p;
    least = std::min(least, std::acos(u.dot(w) / (u.norm() * w.norm())) * 180.0 / M_PI);
  }
  return least;
}

// The promises of the header that hold for every pattern.
void expect_sound(const Pattern& pattern, const PatternMesh& mesh) {
  ASSERT_GT(mesh.triangle_count(), 0);
  std::set<int> used;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    EXPECT_GT(area_of(mesh, f), kLeastTriangleArea);
    const auto nodes = mesh.nodes_of_triangle(f);
    EXPECT_TRUE(nodes[0] != nodes[1] && nodes[1] != nodes[2] && nodes[2] != nodes[0]) << "triangle " << f;
    for (int k = 0; k < 3; ++k) used.insert(mesh.triangles(f, k));
    const PanelRange& range =
        mesh.panels[static_cast<std::size_t>(mesh.panel_of_triangle[static_cast<std::size_t>(f)])];
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(mesh.triangles(f, k) >= range.vertex_begin && mesh.triangles(f, k) < range.vertex_end);
  }
  EXPECT_EQ(static_cast<int>(used.size()), mesh.vertex_count()) << "every vertex belongs to a triangle";
  ASSERT_EQ(mesh.seam_vertices.size(), pattern.seams.size());
  for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
    const Seam& seam = pattern.seams[s];
    const auto& a =
        mesh.edge_vertices[static_cast<std::size_t>(seam.a.panel.value)][static_cast<std::size_t>(seam.a.edge)];
    const auto& b =
        mesh.edge_vertices[static_cast<std::size_t>(seam.b.panel.value)][static_cast<std::size_t>(seam.b.edge)];
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(mesh.seam_vertices[s].size(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(mesh.seam_vertices[s][i], std::pair(a[i], seam.right_wrong ? b[i] : b[b.size() - 1 - i]));
      EXPECT_EQ(mesh.node_of_vertex[static_cast<std::size_t>(mesh.seam_vertices[s][i].first)],
                mesh.node_of_vertex[static_cast<std::size_t>(mesh.seam_vertices[s][i].second)]);
    }
  }
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    EXPECT_EQ(mesh.panel_reversed[p], outline_signed_area(pattern.panels[p]) < 0);
    const auto& edges = mesh.edge_vertices[p];
    ASSERT_EQ(edges.size(), pattern.panels[p].edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) EXPECT_EQ(edges[e].back(), edges[(e + 1) % edges.size()].front());
  }
}

TEST(MeshPanels, EverySharedGarmentIsMeshedSoundly) {
  TOILE_REQUIRE_SHARED_DATA();
  constexpr double kLeastAngle = 20.0;  // degrees, away from outline corners and paired borders
  for (const std::string& name : test::shared_garment_names())
    for (const int triangles : {1000, 10000}) {
      SCOPED_TRACE(name + " with " + std::to_string(triangles));
      const Pattern pattern =
          import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
      const PatternMesh mesh = mesh_panels(pattern, {triangles, {}});
      expect_sound(pattern, mesh);
      EXPECT_NEAR(mesh.triangle_count(), triangles, triangles >= 10000 ? 0.04 * triangles : 0.2 * triangles);
      std::set<int> excused;
      for (const auto& seam : mesh.seam_vertices)
        for (const auto& [a, b] : seam) excused.insert(a), excused.insert(b);
      for (const auto& panel : mesh.edge_vertices)
        for (const auto& edge : panel) excused.insert(edge.front());
      for (int f = 0; f < mesh.triangle_count(); ++f) {
        if (excused.contains(mesh.triangles(f, 0)) || excused.contains(mesh.triangles(f, 1)) ||
            excused.contains(mesh.triangles(f, 2)))
          continue;
        EXPECT_GT(least_angle_degrees(mesh, f), kLeastAngle);
      }
    }
}

TEST(MeshPanels, CoversThePanelsArea) {
  TOILE_REQUIRE_SHARED_DATA();
  const Pattern pattern =
      import_pattern(test::read_file(test::shared_data("garments/skirt_circle_specification.json")));
  const PatternMesh mesh = mesh_panels(pattern);
  double drawn = 0.0, meshed = 0.0;
  for (const Panel& panel : pattern.panels) drawn += std::abs(outline_signed_area(panel));
  for (int f = 0; f < mesh.triangle_count(); ++f) meshed += area_of(mesh, f);
  EXPECT_NEAR(meshed, drawn, 5e-4 * drawn);  // chords of 16 mm along arcs of the waist
}

// Every vertex of the panel has a mirror vertex of the panel's source, and every triangle a mirror triangle.
void expect_mirrored(const PatternMesh& mesh, const PanelMirror& mirror, int panel) {
  const PanelRange& to = mesh.panels[static_cast<std::size_t>(panel)];
  const PanelRange& from = mesh.panels[static_cast<std::size_t>(mirror.source.value)];
  const auto key = [](const Vec2& p) { return std::pair(std::llround(p.x() * 1e5), std::llround(p.y() * 1e5)); };
  std::map<std::pair<long long, long long>, int> vertex_at;
  for (int v = to.vertex_begin; v < to.vertex_end; ++v) vertex_at[key(mesh.rest.row(v))] = v;
  std::map<int, int> image;
  for (int v = from.vertex_begin; v < from.vertex_end; ++v) {
    const Vec2 p = mirror.reflection * mesh.rest.row(v).transpose() + mirror.offset;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const auto found = vertex_at.find({key(p).first + dx, key(p).second + dy});
        if (found != vertex_at.end() && (mesh.rest.row(found->second).transpose() - p).norm() < 1e-6)
          image[v] = found->second;
      }
    ASSERT_TRUE(image.contains(v)) << "vertex " << v << " of panel " << panel << " has no mirror image";
  }
  std::set<std::array<int, 3>> triangles;
  const auto sorted = [](int a, int b, int c) {
    std::array<int, 3> t = {a, b, c};
    std::sort(t.begin(), t.end());
    return t;
  };
  for (int f = to.triangle_begin; f < to.triangle_end; ++f)
    triangles.insert(sorted(mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)));
  for (int f = from.triangle_begin; f < from.triangle_end; ++f)
    EXPECT_TRUE(triangles.contains(
        sorted(image[mesh.triangles(f, 0)], image[mesh.triangles(f, 1)], image[mesh.triangles(f, 2)])));
}

TEST(MeshPanels, MirrorPanelsOfSharedGarmentsMeshSymmetrically) {
  TOILE_REQUIRE_SHARED_DATA();
  int pairs = 0, symmetric = 0;
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Pattern pattern =
        import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
    const PatternMesh mesh = mesh_panels(pattern);
    const PanelMirrors mirrors = find_panel_mirrors(pattern);
    for (int p = 0; p < static_cast<int>(pattern.panels.size()); ++p) {
      const auto at = static_cast<std::size_t>(p);
      if (!mirrors.pairs[at].empty()) expect_mirrored(mesh, mirrors.pairs[at].front(), p), ++pairs;
      if (mirrors.self[at]) expect_mirrored(mesh, *mirrors.self[at], p), ++symmetric;
    }
  }
  EXPECT_GT(pairs, 50);
  EXPECT_GT(symmetric, 20);
}

TEST(MeshPanels, ShortEdgesCollapseOnBothSidesOfTheirSeam) {
  Pattern pattern;
  // Edge 1 of both panels is 2 mm long; they are sewn along edges 1 and 2.
  pattern.panels.push_back(polygon_panel("a", {{0, 0}, {0.1, 0}, {0.1, 0.002}, {0.1, 0.1}, {0, 0.1}}));
  pattern.panels.push_back(polygon_panel("b", {{0.2, 0}, {0.3, 0}, {0.3, 0.1}, {0.2, 0.1}, {0.2, 0.002}}));
  pattern.seams.push_back({{PanelId(0), 1}, {PanelId(1), 4}, false});
  pattern.seams.push_back({{PanelId(0), 2}, {PanelId(1), 3}, false});
  const PatternMesh coarse = mesh_panels(pattern, {500, 0.02});
  expect_sound(pattern, coarse);
  EXPECT_EQ(coarse.edge_vertices[0][1].size(), 1u);
  EXPECT_EQ(coarse.edge_vertices[1][4].size(), 1u);
  EXPECT_NEAR(coarse.rest(coarse.edge_vertices[0][1][0], 1), 0.001, 1e-12);
  const PatternMesh fine = mesh_panels(pattern, {500, 0.005});
  EXPECT_EQ(fine.edge_vertices[0][1].size(), 2u);
}

TEST(MeshPanels, ANarrowStripKeepsItsEnds) {
  Pattern pattern;
  pattern.panels.push_back(polygon_panel("strip", {{0, 0}, {0.008, 0}, {0.008, 0.5}, {0, 0.5}}));
  const PatternMesh mesh = mesh_panels(pattern, {500, 0.04});
  expect_sound(pattern, mesh);
  for (const auto& edge : mesh.edge_vertices[0]) EXPECT_GE(edge.size(), 2u);
  double area = 0.0;
  for (int f = 0; f < mesh.triangle_count(); ++f) area += area_of(mesh, f);
  EXPECT_NEAR(area, 0.004, 1e-9);
}

TEST(MeshPanels, NotchesBecomeVerticesOnBothSidesOfTheSeam) {
  Pattern pattern;
  pattern.panels.push_back(polygon_panel("a", {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}));
  pattern.panels.push_back(polygon_panel("b", {{0.2, 0}, {0.3, 0}, {0.3, 0.1}, {0.2, 0.1}}));
  pattern.panels[0].notches.push_back({1, 0.23, NotchType::V});
  pattern.seams.push_back({{PanelId(0), 1}, {PanelId(1), 3}, false});
  const PatternMesh mesh = mesh_panels(pattern, {500, 0.01});
  expect_sound(pattern, mesh);
  const auto has_height = [&](const std::vector<int>& vertices, double y) {
    return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return std::abs(mesh.rest(v, 1) - y) < 1e-12; });
  };
  EXPECT_TRUE(has_height(mesh.edge_vertices[0][1], 0.023));
  EXPECT_TRUE(has_height(mesh.edge_vertices[1][3], 0.023));
}

TEST(MeshPanels, ADartAndAConeSewIntoDistinctNodes) {
  Pattern pattern;
  // A square with a dart cut into its lower edge, and a wedge whose two straight sides are sewn to each other.
  pattern.panels.push_back(
      polygon_panel("dart", {{0, 0}, {0.045, 0}, {0.05, 0.06}, {0.055, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}));
  pattern.panels.push_back(polygon_panel("cone", {{0.2, 0}, {0.3, 0}, {0.29, 0.05}}));
  pattern.seams.push_back({{PanelId(0), 1}, {PanelId(0), 2}, false});
  pattern.seams.push_back({{PanelId(1), 0}, {PanelId(1), 2}, false});
  for (const double h : {0.004, 0.01, 0.03, 0.08}) {
    SCOPED_TRACE(h);
    expect_sound(pattern, mesh_panels(pattern, {500, h}));
  }
}

TEST(MeshPanels, RightWrongSeamsPairStartWithStart) {
  Pattern pattern;
  pattern.panels.push_back(polygon_panel("a", {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}));
  pattern.panels.push_back(polygon_panel("b", {{0.2, 0}, {0.3, 0}, {0.3, 0.1}, {0.2, 0.1}}));
  pattern.seams.push_back({{PanelId(0), 1}, {PanelId(1), 1}, true});
  const PatternMesh mesh = mesh_panels(pattern, {500, 0.02});
  expect_sound(pattern, mesh);
  for (const auto& [a, b] : mesh.seam_vertices[0]) EXPECT_NEAR(mesh.rest(a, 1), mesh.rest(b, 1), 1e-12);
}

TEST(MeshPanels, ClockwisePanelsAreMeshedCounterClockwise) {
  Pattern pattern;
  pattern.panels.push_back(polygon_panel("back", {{0, 0}, {0, 0.1}, {0.1, 0.1}, {0.1, 0}}));
  const PatternMesh mesh = mesh_panels(pattern, {500, {}});
  expect_sound(pattern, mesh);
  EXPECT_TRUE(mesh.panel_reversed[0]);
}

TEST(MeshPanels, AFinePolylineDoesNotVanishIntoOneVertex) {
  Pattern pattern;
  std::vector<Vec2> circle;
  for (int i = 0; i < 1000; ++i)
    circle.emplace_back(0.1 * std::cos(i * 2 * M_PI / 1000), 0.1 * std::sin(i * 2 * M_PI / 1000));
  pattern.panels.push_back(polygon_panel("disc", circle));
  const PatternMesh mesh = mesh_panels(pattern, {500, 0.02});
  expect_sound(pattern, mesh);
  double area = 0.0;
  for (int f = 0; f < mesh.triangle_count(); ++f) area += area_of(mesh, f);
  EXPECT_NEAR(area, M_PI * 0.01, 0.02 * M_PI * 0.01);
}

TEST(MeshPanels, ThinSliversAreSampledFinelyInsteadOfCrossing) {
  Pattern pattern;
  // Two nearly parallel arcs, 1 mm apart in the middle: coarse chords would cross.
  Panel panel = polygon_panel("crescent", {{0, 0}, {0.3, 0}});
  panel.edges[0].curve.kind = CurveKind::QuadraticBezier;
  panel.edges[0].curve.control[0] = {0.15, 0.2};
  panel.edges[1].curve.kind = CurveKind::QuadraticBezier;
  panel.edges[1].curve.control[0] = {0.15, 0.202};
  pattern.panels.push_back(panel);
  validate_pattern(pattern);
  const PatternMesh mesh = mesh_panels(pattern, {500, 0.1});
  expect_sound(pattern, mesh);
}

TEST(MeshPanels, SameBytesForTheSamePattern) {
  TOILE_REQUIRE_SHARED_DATA();
  const Pattern pattern = import_pattern(test::read_file(test::shared_data("garments/shirt_lapel_specification.json")));
  const PatternMesh a = mesh_panels(pattern), b = mesh_panels(pattern);
  EXPECT_TRUE(a.rest == b.rest);
  EXPECT_TRUE(a.triangles == b.triangles);
  EXPECT_EQ(a.node_of_vertex, b.node_of_vertex);
}

TEST(MeshPanels, RefusesTargetsOutsideTheirRange) {
  Pattern pattern;
  pattern.panels.push_back(polygon_panel("a", {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}));
  EXPECT_THROW(mesh_panels(pattern, {100, {}}), Error);
  EXPECT_THROW(mesh_panels(pattern, {500, -1.0}), Error);
  EXPECT_THROW(mesh_panels(pattern, {500, 1e-6}), Error);
}

}  // namespace
}  // namespace toile
