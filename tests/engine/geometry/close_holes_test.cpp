// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/close_holes.h"

#include <gtest/gtest.h>

#include "engine/geometry/clean_mesh.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/half_edges.h"
#include "engine/geometry/hole_triangulation.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/solids.h"

namespace toile {
namespace {

using test::make_sphere;

template <class Gone>
TriangleMesh without_triangles(const TriangleMesh& mesh, Gone gone) {
  std::vector<int> kept;
  for (int f = 0; f < mesh.triangle_count(); ++f)
    if (!gone(f)) kept.push_back(f);
  TriangleMesh out = mesh;
  out.triangles = mesh.triangles(kept, Eigen::all);
  clean_mesh(out);
  return out;
}

// The mesh without the triangles for which `inside` holds at the centre.
template <class Inside>
TriangleMesh without(const TriangleMesh& mesh, Inside inside) {
  return without_triangles(mesh, [&](int f) {
    return inside(Vec3((mesh.vertices.row(mesh.triangles(f, 0)) + mesh.vertices.row(mesh.triangles(f, 1)) +
                        mesh.vertices.row(mesh.triangles(f, 2))) /
                       3));
  });
}

TEST(CloseHoles, ACapCutFromASphereGrowsBackRound) {
  const double radius = 0.1;
  const TriangleMesh sphere = make_sphere(radius, 60, 90);
  TriangleMesh mesh = without(sphere, [&](const Vec3& p) { return p.x() > 0.8 * radius; });
  const int before = mesh.vertex_count();
  const auto holes = close_holes(mesh);
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_GT(holes[0].added_vertices, 50);
  EXPECT_TRUE(test::is_closed(mesh));
  double worst = 0;
  for (int v = before; v < mesh.vertex_count(); ++v)
    worst = std::max(worst, std::abs(mesh.vertices.row(v).norm() - radius));
  // A flat lid would miss by 0.2 radius; a thin plate with the right rim tangents misses by a few per cent.
  EXPECT_LT(worst, 0.025 * radius);
  EXPECT_NEAR(test::volume_of(mesh), test::volume_of(sphere), 0.005 * test::volume_of(sphere));
}

TEST(CloseHoles, NewEdgesAreAsLongAsThoseAroundTheHole) {
  const TriangleMesh sphere = make_sphere(0.1, 60, 90);
  TriangleMesh mesh = without(sphere, [&](const Vec3& p) { return p.x() > 0.06; });
  const int before = mesh.triangle_count();
  close_holes(mesh);
  double mean = 0, outside = 0;
  const auto edge = [&](int f) {
    return (mesh.vertices.row(mesh.triangles(f, 0)) - mesh.vertices.row(mesh.triangles(f, 1))).norm();
  };
  for (int f = before; f < mesh.triangle_count(); ++f) mean += edge(f) / (mesh.triangle_count() - before);
  for (int f = 0; f < before; ++f) outside += edge(f) / before;
  EXPECT_GT(mean, 0.5 * outside);
  EXPECT_LT(mean, 2.0 * outside);
}

TEST(CloseHoles, NothingNewComesBelowTheFloor) {
  const TriangleMesh sphere = make_sphere(0.1, 60, 90);
  TriangleMesh mesh = without(sphere, [&](const Vec3& p) { return p.y() < -0.09; });
  const double floor = mesh.vertices.col(1).minCoeff();
  TriangleMesh round = mesh;
  close_holes(round);
  ASSERT_LT(round.vertices.col(1).minCoeff(), floor - 1e-3);
  close_holes(mesh, {.lowest_y = floor});
  EXPECT_EQ(mesh.vertices.col(1).minCoeff(), floor);
  EXPECT_TRUE(test::is_closed(mesh));
}

TEST(CloseHoles, LongLoopsAndSeveralHolesAreClosedToo) {
  const TriangleMesh sphere = make_sphere(0.1, 200, 300);
  TriangleMesh mesh =
      without(sphere, [&](const Vec3& p) { return p.y() > 0.02 || (p - Vec3(0, -0.08, 0.06)).norm() < 0.02; });
  const auto holes = close_holes(mesh);
  ASSERT_EQ(holes.size(), 2u);
  EXPECT_GE(std::max(holes[0].edges, holes[1].edges), 300);
  EXPECT_TRUE(test::is_closed(mesh));
}

TEST(CloseHoles, EverySmallHoleOfABoxCanBeClosed) {
  const TriangleMesh box = test::make_box(Vec3::Zero(), Vec3::Ones());
  for (int mask = 1; mask < 1 << 12; ++mask) {
    if (__builtin_popcount(static_cast<unsigned>(mask)) > 4) continue;
    TriangleMesh mesh = without_triangles(box, [&](int f) { return mask >> f & 1; });
    close_holes(mesh);
    EXPECT_TRUE(test::is_closed(mesh)) << mask;
  }
}

TEST(CloseHoles, ForbiddenDiagonalsAreAvoided) {
  HoleLoop square;
  square.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1.2, 0)};
  square.normals.assign(4, Vec3::UnitZ());
  square.joined = [](int, int) { return false; };
  EXPECT_EQ(triangulate_hole(square).size(), 2u);
  square.joined = [](int i, int k) { return i + k == 2; };  // 0-2
  for (const Eigen::Vector3i& t : triangulate_hole(square))
    EXPECT_TRUE((t.array() == 1).any() && (t.array() == 3).any());
  square.joined = [](int, int) { return true; };
  EXPECT_TRUE(triangulate_hole(square).empty());
}

TEST(CloseHoles, ScansComeOutClosedManifoldAndOriented) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"scan_a", "scan_b", "scan_c", "scan_d"}) {
    TriangleMesh mesh = test::load_shared_scan(name);
    ASSERT_FALSE(test::is_closed(mesh)) << name;
    clean_mesh(mesh);
    EXPECT_GE(close_holes(mesh).size(), 7u) << name;
    orient_outward(mesh);
    EXPECT_TRUE(test::is_closed(mesh)) << name;
    EXPECT_GT(test::volume_of(mesh), 0) << name;
  }
}

TEST(CloseHoles, PatchesOfAScanLieWhereTheSkinWas) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh truth = test::load_shared_body("mh_female_heavy_tall").surface;
  const SurfaceTree tree(truth.vertices, truth.triangles);
  TriangleMesh mesh = test::load_shared_scan("scan_a");
  clean_mesh(mesh);
  const int before = mesh.vertex_count();
  close_holes(mesh, {.lowest_y = mesh.vertices.col(1).minCoeff()});
  ASSERT_GT(mesh.vertex_count(), before + 500);
  double sum = 0;
  for (int v = before; v < mesh.vertex_count(); ++v)
    sum += tree.closest_point(mesh.vertices.row(v).transpose()).distance();
  const double mean = sum / (mesh.vertex_count() - before);
  RecordProperty("mean_mm", std::to_string(mean * 1e3));
  EXPECT_LT(mean, 0.008);
}

}  // namespace
}  // namespace toile
