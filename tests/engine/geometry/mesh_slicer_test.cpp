// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/mesh_slicer.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/geometry/components.h"
#include "engine/geometry/convex_hull.h"
#include "engine/geometry/edge_graph.h"

namespace toile {
namespace {

// Open tube of `sides` flat faces about (x, 0), from y = 0 to 1 in ten steps.
TriangleMesh tube(double radius, int sides, double x = 0.0) {
  constexpr int steps = 10;
  TriangleMesh m;
  m.vertices.resize(sides * (steps + 1), 3);
  m.triangles.resize(sides * steps * 2, 3);
  for (int k = 0; k <= steps; ++k)
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * std::numbers::pi * i / sides;
      m.vertices.row(k * sides + i) << x + radius * std::cos(a), 0.1 * k, radius * std::sin(a);
    }
  for (int k = 0, f = 0; k < steps; ++k)
    for (int i = 0; i < sides; ++i) {
      const int j = (i + 1) % sides, a = k * sides + i, b = k * sides + j;
      m.triangles.row(f++) << a, a + sides, b;
      m.triangles.row(f++) << b, a + sides, b + sides;
    }
  return m;
}

TriangleMesh both(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh m;
  m.vertices.resize(a.vertex_count() + b.vertex_count(), 3);
  m.vertices << a.vertices, b.vertices;
  m.triangles.resize(a.triangle_count() + b.triangle_count(), 3);
  m.triangles << a.triangles, (b.triangles.array() + a.vertex_count()).matrix();
  return m;
}

TEST(MeshSlicer, MeasuresThePolygonOfATubeExactly) {
  const TriangleMesh mesh = tube(0.2, 24);
  const MeshSlicer slicer(mesh);
  const double exact = 24 * 2 * 0.2 * std::sin(std::numbers::pi / 24);
  for (const double y : {0.0, 0.05, 0.1, 0.333, 0.7, 1.0 - 1e-9}) {  // through vertices and between them
    const auto pieces = slicer.slice(y);
    if (y == 0.0) continue;  // nothing lies below the lowest vertices
    ASSERT_EQ(pieces.size(), 1u) << y;
    EXPECT_NEAR(pieces[0].hull_girth(), exact, 1e-12) << y;
  }
  EXPECT_TRUE(slicer.slice(1.5).empty());
}

TEST(MeshSlicer, PartsPiecesAndMergesNearOnes) {
  const TriangleMesh mesh = both(tube(0.1, 16, -0.11), tube(0.1, 16, 0.11));
  const MeshSlicer slicer(mesh);
  EXPECT_EQ(slicer.slice(0.55).size(), 2u);
  EXPECT_EQ(slicer.slice(0.55, 0.01).size(), 2u);
  const auto merged = slicer.slice(0.55, 0.03);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(merged[0].high.x() - merged[0].low.x(), 0.42, 1e-12);
}

TEST(MeshSlicer, ClipsPointsAtBounds) {
  const TriangleMesh mesh = tube(0.2, 64);
  const auto pieces = MeshSlicer(mesh).slice(0.5);
  double front = 0.0;
  for (const Vec2& p : pieces.at(0).points(-0.001, 0.001)) {
    EXPECT_LE(std::abs(p.x()), 0.001);
    front = std::max(front, p.y());
  }
  EXPECT_NEAR(front, 0.2, 0.001);
}

TEST(ConvexHull, IgnoresInnerAndCollinearPoints) {
  EXPECT_NEAR(hull_perimeter({{0, 0}, {1, 0}, {0.5, 0}, {1, 1}, {0, 1}, {0.4, 0.6}, {0, 0}}), 4.0, 1e-15);
  EXPECT_EQ(hull_perimeter({{1, 1}}), 0.0);
  EXPECT_NEAR(hull_perimeter({{0, 0}, {3, 4}}), 10.0, 1e-15);
}

TEST(EdgeGraph, FindsTheShortestWayAlongATube) {
  const TriangleMesh mesh = tube(0.2, 24);
  const EdgeGraph graph(mesh);
  EXPECT_EQ(graph.edges().size(), 24u * 11 + 24 * 10 * 2);
  const Eigen::VectorXd d = graph.distances(std::array{0});
  EXPECT_EQ(d[0], 0.0);
  EXPECT_NEAR(d[240], 1.0, 1e-12);                                            // straight up
  EXPECT_NEAR(d[12], 12 * 2 * 0.2 * std::sin(std::numbers::pi / 24), 1e-12);  // half round
}

TEST(EdgeGraph, LeavesOtherPiecesUnreached) {
  const TriangleMesh mesh = both(tube(0.1, 8, -1), tube(0.1, 8, 1));
  EXPECT_TRUE(std::isinf(EdgeGraph(mesh).distances(std::array{0})[mesh.vertex_count() - 1]));
}

TEST(Components, AreNumberedByAreaAndExtracted) {
  const TriangleMesh mesh = both(tube(0.1, 8, -1), tube(0.3, 8, 1));
  const MeshComponents found = find_components(mesh);
  ASSERT_EQ(found.area.size(), 2u);
  EXPECT_NEAR(found.area[0] / found.area[1], 3.0, 1e-12);
  EXPECT_EQ(found.of_triangle.front(), 1);
  std::vector<bool> keep(found.of_triangle.size());
  for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = found.of_triangle[f] == 0;
  const TriangleMesh large = extract_triangles(mesh, keep);
  EXPECT_EQ(large.vertex_count(), 88);
  EXPECT_EQ(large.triangle_count(), 160);
  EXPECT_GT(large.vertices.col(0).minCoeff(), 0.0);
}

}  // namespace
}  // namespace toile
