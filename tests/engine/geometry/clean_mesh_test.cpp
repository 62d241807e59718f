// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/clean_mesh.h"

#include <gtest/gtest.h>

#include "engine/geometry/half_edges.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/solids.h"

namespace toile {
namespace {

using test::make_box;
using test::make_sphere;

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh;
  mesh.vertices.resize(a.vertex_count() + b.vertex_count(), 3);
  mesh.vertices << a.vertices, b.vertices;
  mesh.triangles.resize(a.triangle_count() + b.triangle_count(), 3);
  mesh.triangles << a.triangles, (b.triangles.array() + a.vertex_count()).matrix();
  return mesh;
}

void add_triangle(TriangleMesh& mesh, int a, int b, int c) {
  mesh.triangles.conservativeResize(mesh.triangle_count() + 1, 3);
  mesh.triangles.bottomRows(1) << a, b, c;
}

TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  soup.vertices.resize(3 * mesh.triangle_count(), 3);
  soup.triangles.resize(mesh.triangle_count(), 3);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      soup.vertices.row(3 * f + k) = mesh.vertices.row(mesh.triangles(f, k));
      soup.triangles(f, k) = 3 * f + k;
    }
  return soup;
}

TEST(CleanMesh, ACleanSurfaceComesBackUnchanged) {
  const TriangleMesh sphere = make_sphere(1, 12, 20);
  ASSERT_TRUE(test::is_closed(sphere));
  TriangleMesh mesh = sphere;
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(mesh.vertices, sphere.vertices);
  EXPECT_EQ(mesh.triangles, sphere.triangles);
  EXPECT_EQ(report.flipped_triangles + report.slivers + report.split_vertices + report.unused_vertices, 0);
}

TEST(CleanMesh, ATriangleSoupIsWelded) {
  const TriangleMesh sphere = make_sphere(1, 12, 20);
  TriangleMesh mesh = soup_of(sphere);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.welded_vertices, 3 * sphere.triangle_count() - sphere.vertex_count());
  EXPECT_EQ(report.unused_vertices, 0);
  EXPECT_EQ(mesh.vertex_count(), sphere.vertex_count());
  EXPECT_TRUE(test::is_closed(mesh));
}

TEST(CleanMesh, TouchingPointsOfAClosedSurfaceAreNotWelded) {
  TriangleMesh two = joined(make_box(Vec3(0, 0, 0), Vec3(1, 1, 1)), make_box(Vec3(1, 0, 0), Vec3(2, 1, 1)));
  const TriangleMesh before = two;
  EXPECT_EQ(clean_mesh(two).welded_vertices, 0);
  EXPECT_EQ(two.triangles, before.triangles);
}

TEST(CleanMesh, SpecksBelowTwoPercentOfTheAreaGo) {
  TriangleMesh mesh = joined(make_sphere(1, 12, 20), make_sphere(0.1, 4, 6, Vec3(3, 0, 0)));
  mesh = joined(mesh, make_sphere(0.4, 4, 6, Vec3(-3, 0, 0)));
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.specks, 1);
  EXPECT_EQ(report.speck_triangles, 48);
  EXPECT_EQ(mesh.vertex_count(), 242 + 26);
}

TEST(CleanMesh, StrayTrianglesGoHoweverLargeTheyAre) {
  const TriangleMesh sphere = make_sphere(1, 12, 20);
  TriangleMesh mesh = sphere;
  add_triangle(mesh, 10, 130, 77);
  add_triangle(mesh, 25, 101, 190);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.pinched_triangles, 2);
  EXPECT_TRUE(test::is_closed(mesh));
  EXPECT_EQ(mesh.triangles, sphere.triangles);
}

TEST(CleanMesh, OpenPiecesOfAFewTrianglesGoHoweverLargeTheyAre) {
  const TriangleMesh sphere = make_sphere(1, 12, 20);
  TriangleMesh mesh = sphere;
  mesh.vertices.conservativeResize(mesh.vertex_count() + 3, 3);
  mesh.vertices.bottomRows(3) << 2, 0, 0, 3, 0, 0, 2, 1, 0;
  add_triangle(mesh, mesh.vertex_count() - 3, mesh.vertex_count() - 2, mesh.vertex_count() - 1);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.specks, 1);
  EXPECT_EQ(mesh.vertices, sphere.vertices);
}

TEST(CleanMesh, RepeatedCornersCopiesAndFoldsGo) {
  TriangleMesh mesh = make_sphere(1, 12, 20);
  const TriangleMesh sphere = mesh;
  add_triangle(mesh, 5, 5, 9);
  add_triangle(mesh, mesh.triangles(7, 1), mesh.triangles(7, 2), mesh.triangles(7, 0));
  // A fold: two opposite triangles that stand on an edge of the sphere and meet in a new point.
  mesh.vertices.conservativeResize(mesh.vertex_count() + 1, 3);
  mesh.vertices.bottomRows(1) << 2, 0, 0;
  const int tip = mesh.vertex_count() - 1, a = mesh.triangles(3, 0), b = mesh.triangles(3, 1);
  add_triangle(mesh, a, b, tip);
  add_triangle(mesh, b, a, tip);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.repeated_corners, 1);
  EXPECT_EQ(report.duplicate_triangles, 3);
  EXPECT_EQ(mesh.triangles, sphere.triangles);
  EXPECT_EQ(mesh.vertices, sphere.vertices);
}

TEST(CleanMesh, AFinOnAnEdgeIsCutOffAndLeavesAManifold) {
  TriangleMesh mesh = make_sphere(1, 12, 20);
  mesh.vertices.conservativeResize(mesh.vertex_count() + 1, 3);
  mesh.vertices.bottomRows(1) << 2, 0, 0;
  add_triangle(mesh, mesh.triangles(3, 0), mesh.triangles(3, 1), mesh.vertex_count() - 1);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.tangled_triangles, 3);
  const SurfaceDefects defects = find_defects(mesh.vertex_count(), mesh.triangles);
  EXPECT_EQ(defects.open_edges, 4);
  EXPECT_EQ(defects.tangled_edges + defects.twisted_edges + defects.pinched_vertices, 0);
}

TEST(CleanMesh, MixedOrientationIsMadeToAgreeAndOutward) {
  const TriangleMesh sphere = make_sphere(1, 12, 20);
  TriangleMesh mesh = sphere;
  for (int f = 0; f < mesh.triangle_count(); f += 3) std::swap(mesh.triangles(f, 0), mesh.triangles(f, 1));
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.flipped_triangles, (sphere.triangle_count() + 2) / 3);
  EXPECT_TRUE(test::is_closed(mesh));
  EXPECT_NEAR(test::volume_of(mesh), test::volume_of(sphere), 1e-12);

  for (int f = 0; f < mesh.triangle_count(); ++f) std::swap(mesh.triangles(f, 0), mesh.triangles(f, 1));
  EXPECT_EQ(clean_mesh(mesh).flipped_triangles, 0);
  EXPECT_EQ(orient_outward(mesh), mesh.triangle_count());
  EXPECT_NEAR(test::volume_of(mesh), test::volume_of(sphere), 1e-12);
}

TEST(CleanMesh, ASharedPointOfTwoSheetsIsSplit) {
  TriangleMesh mesh = joined(make_sphere(1, 12, 20), make_sphere(1, 12, 20, Vec3(0, 2, 0)));
  const int north_of_lower = 240, south_of_upper = 242 + 241;
  mesh.triangles = mesh.triangles.unaryExpr([&](int v) { return v == south_of_upper ? north_of_lower : v; });
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.split_vertices, 1);
  EXPECT_EQ(report.unused_vertices, 1);
  EXPECT_TRUE(test::is_closed(mesh));
}

TEST(CleanMesh, AFlapThatHangsByAPointAtARimGoes) {
  TriangleMesh mesh = make_sphere(1, 12, 20);
  // Open the north but for one triangle, which then hangs by its lower vertices and its neighbours' rims.
  const int north = 240;
  std::vector<int> kept;
  for (int f = 0; f < mesh.triangle_count(); ++f)
    if (!(mesh.triangles.row(f).array() == north).any()) kept.push_back(f);
  mesh.triangles = mesh.triangles(kept, Eigen::all).eval();
  add_triangle(mesh, north, 0, 6);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.pinched_triangles, 1);
  EXPECT_EQ(report.split_vertices, 0);
  EXPECT_EQ(find_defects(mesh.vertex_count(), mesh.triangles).pinched_vertices, 0);
  EXPECT_EQ(find_defects(mesh.vertex_count(), mesh.triangles).open_edges, 20);
}

TEST(CleanMesh, AMoebiusBandBecomesOrientable) {
  const int n = 24;
  TriangleMesh mesh;
  mesh.vertices.resize(2 * n, 3);
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    for (int side = 0; side < 2; ++side) {
      const double w = side ? 0.3 : -0.3, r = 1 + w * std::cos(t / 2);
      mesh.vertices.row(2 * i + side) << r * std::cos(t), r * std::sin(t), w * std::sin(t / 2);
    }
  }
  for (int i = 0; i < n; ++i) {
    const bool last = i == n - 1;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, c, b, d);
  }
  ASSERT_EQ(find_defects(mesh.vertex_count(), mesh.triangles).twisted_edges, 1);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_GT(report.one_sided_triangles, 0);
  EXPECT_GT(mesh.triangle_count(), n);
  EXPECT_EQ(find_defects(mesh.vertex_count(), mesh.triangles).twisted_edges, 0);
}

TEST(CleanMesh, SliversAreCollapsedOrFlippedWithoutOpeningTheSurface) {
  TriangleMesh mesh = make_sphere(1, 12, 20);
  const double volume = test::volume_of(mesh);
  // A point on the middle of an edge, joined only to the triangle on one side: a triangle without area (a cap).
  const Eigen::RowVector3i t = mesh.triangles.row(50);
  mesh.vertices.conservativeResize(mesh.vertex_count() + 1, 3);
  const int m = mesh.vertex_count() - 1;
  mesh.vertices.row(m) = (mesh.vertices.row(t[0]) + mesh.vertices.row(t[1])) / 2;
  mesh.triangles.row(50) << t[0], m, t[2];
  add_triangle(mesh, m, t[1], t[2]);
  add_triangle(mesh, t[0], t[1], m);
  ASSERT_TRUE(test::is_closed(mesh));
  // And a vertex that all but coincides with its neighbour (needles).
  mesh.vertices.row(100) = mesh.vertices.row(101) * (1 - 1e-9);
  const CleanMeshReport report = clean_mesh(mesh);
  EXPECT_GE(report.slivers, 2);
  EXPECT_TRUE(test::is_closed(mesh));
  EXPECT_NEAR(test::volume_of(mesh), volume, 0.01 * volume);
  TriangleMesh again = mesh;
  EXPECT_EQ(clean_mesh(again).slivers, 0);
}

TEST(CleanMesh, SharedBodiesNeedNothing) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const TriangleMesh given = test::load_shared_body(name).surface;
    TriangleMesh mesh = given;
    clean_mesh(mesh);
    EXPECT_EQ(mesh.vertices, given.vertices) << name;
    EXPECT_EQ(mesh.triangles, given.triangles) << name;
    EXPECT_TRUE(test::is_closed(mesh)) << name;
  }
}

}  // namespace
}  // namespace toile
