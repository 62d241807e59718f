// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/import_body.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/half_edges.h"
#include "engine/io/mesh_file.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/solids.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

ErrorCode code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_FALSE(error.subject.empty());
    EXPECT_GE(error.message.size(), 20u) << error.message;
    return error.code;
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::Internal;
}

TEST(ImportBody, ABodyThatAlreadyStandsSoKeepsItsMeshAndCoordinates) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const TriangleMesh given = test::load_shared_body(name).surface;
    const ImportBodyResult result = import_body(given, name);
    EXPECT_EQ(result.body.surface.vertices, given.vertices) << name;
    EXPECT_EQ(result.body.surface.triangles, given.triangles) << name;
    EXPECT_EQ(result.body.normalised_from_file, Mat4::Identity()) << name;
    EXPECT_TRUE(result.repairs.holes.empty()) << name;
  }
}

struct Scan {
  const char* name;
  LengthUnit unit;
  UpAxis up;
};

TEST(ImportBody, ScansComeOutClosedOrientedAndOnTheirBodies) {
  TOILE_REQUIRE_SHARED_DATA();
  const Scan scans[] = {{"scan_a", LengthUnit::Metre, UpAxis::PlusY},
                        {"scan_b", LengthUnit::Millimetre, UpAxis::PlusZ},
                        {"scan_c", LengthUnit::Metre, UpAxis::PlusY},
                        {"scan_d", LengthUnit::Centimetre, UpAxis::PlusY}};
  for (const Scan& scan : scans) {
    const ImportBodyResult result = import_body(test::shared_scan_bytes(scan.name), scan.name);
    const TriangleMesh& skin = result.body.surface;
    EXPECT_TRUE(find_defects(skin.vertex_count(), skin.triangles).none()) << scan.name;
    EXPECT_GT(test::volume_of(skin), 0.01) << scan.name;
    EXPECT_EQ(result.normalisation.unit, scan.unit) << scan.name;
    EXPECT_EQ(result.normalisation.up, scan.up) << scan.name;
    EXPECT_GE(result.repairs.holes.size(), 7u) << scan.name;
    EXPECT_GE(skin.vertices.col(1).minCoeff(), -0.002) << scan.name;
    EXPECT_EQ(result.repairs.cleaning.specks, scan.name == std::string("scan_c") ? 6 : 0) << scan.name;
    EXPECT_LE(result.repairs.cleaning.pinched_triangles, 20) << scan.name;
  }
}

TEST(ImportBody, ATurnedScanLiesOnItsSourceBodyOverall) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const auto& [scan, source] :
       {std::pair("scan_a", "mh_female_heavy_tall"), std::pair("scan_b", "ggg_large_male")}) {
    const TriangleMesh truth = test::load_shared_body(source).surface;
    const SurfaceTree tree(truth.vertices, truth.triangles);
    const TriangleMesh skin = import_body(test::shared_scan_bytes(scan), scan).body.surface;
    double sum = 0;
    for (int v = 0; v < skin.vertex_count(); ++v)
      sum += std::min(0.1, tree.closest_point(skin.vertices.row(v).transpose()).distance());
    // Noise 1-2 mm; scan b is put on the floor without its soles, 3-7 mm too low [registration.md, 1.1].
    EXPECT_LT(sum / skin.vertex_count(), 0.006) << scan;
  }
}

TEST(ImportBody, SolesAreClosedFlatOnTheFloor) {
  TOILE_REQUIRE_SHARED_DATA();
  const ImportBodyResult result = import_body(test::shared_scan_bytes("scan_a"), "scan_a");
  int soles = 0;
  for (const ClosedHole& hole : result.repairs.holes) soles += hole.centre.y() < 0.02;
  EXPECT_GE(soles, 2);
  int on_floor = 0;
  for (int v = 0; v < result.body.surface.vertex_count(); ++v) on_floor += result.body.surface.vertices(v, 1) == 0.0;
  EXPECT_GT(on_floor, 20);
}

// Holes, missing, copied, turned and junk triangles, spikes and doubled points, as bad exports and scanners leave them.
TriangleMesh damaged(const TriangleMesh& body, unsigned seed) {
  std::mt19937 random(seed);
  const auto any = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  TriangleMesh mesh = body;
  std::vector<Vec3> holes;
  for (int i = 0; i < 8; ++i) holes.push_back(body.vertices.row(any(body.vertex_count())).transpose());
  std::vector<Eigen::RowVector3i> kept;
  for (int f = 0; f < body.triangle_count(); ++f) {
    const Vec3 p = body.vertices.row(body.triangles(f, 0)).transpose();
    const bool in_hole = std::any_of(holes.begin(), holes.end(), [&](const Vec3& h) { return (h - p).norm() < 0.03; });
    if (in_hole || any(100) == 0) continue;
    kept.push_back(body.triangles.row(f));
    if (any(20) == 0) std::swap(kept.back()[0], kept.back()[1]);
    if (any(500) == 0) kept.push_back(kept.back());
  }
  for (int i = 0; i < 30; ++i)
    kept.emplace_back(any(body.vertex_count()), any(body.vertex_count()), any(body.vertex_count()));
  mesh.triangles.resize(static_cast<int>(kept.size()), 3);
  for (std::size_t f = 0; f < kept.size(); ++f) mesh.triangles.row(static_cast<int>(f)) = kept[f];
  for (int i = 0; i < 30; ++i) {
    mesh.vertices.row(any(mesh.vertex_count())).array() += 0.01 * (any(3) - 1);
    const int f = any(mesh.triangle_count());
    mesh.vertices.row(mesh.triangles(f, 0)) = mesh.vertices.row(mesh.triangles(f, 1)).eval();
  }
  return mesh;
}

TEST(ImportBody, DamagedBodiesComeOutClosedAndWhereTheyWere) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"mh_female_average", "mh_child_8y", "mh_male_old_heavy"}) {
    const TriangleMesh truth = test::load_shared_body(name).surface;
    for (unsigned seed = 1; seed <= 2; ++seed) {
      const ImportBodyResult result = import_body(damaged(truth, seed), name);
      const TriangleMesh& skin = result.body.surface;
      EXPECT_TRUE(find_defects(skin.vertex_count(), skin.triangles).none()) << name << seed;
      EXPECT_NEAR(test::volume_of(skin), test::volume_of(truth), 0.01 * test::volume_of(truth)) << name << seed;
      EXPECT_GT(result.repairs.cleaning.flipped_triangles, 500) << name << seed;
      EXPECT_GT(result.repairs.holes.size(), 100u) << name << seed;
    }
  }
}

TEST(ImportBody, TheSameBytesGiveTheSameBody) {
  TOILE_REQUIRE_SHARED_DATA();
  const Bytes bytes = test::shared_scan_bytes("scan_d");
  const ImportBodyResult first = import_body(bytes, "scan_d"), second = import_body(bytes, "scan_d");
  EXPECT_EQ(write_obj(first.body.surface), write_obj(second.body.surface));
  EXPECT_EQ(first.body.surface.vertices, second.body.surface.vertices);
}

TEST(ImportBody, CubesAndTinyBodiesAreRefusedAsPersons) {
  const TriangleMesh cube = test::make_box(Vec3(-0.5, 0, -0.5), Vec3(0.5, 1.0, 0.5));
  EXPECT_EQ(code_of([&] { import_body(cube, "cube.obj"); }), ErrorCode::BodyNotRecognised);
  TriangleMesh broken = cube;
  for (int f = 0; f < 12; ++f) broken.triangles(f, 1) = broken.triangles(f, 0);
  EXPECT_EQ(code_of([&] { import_body(broken, "broken.obj"); }), ErrorCode::BodyUnusable);
}

TEST(ImportBody, ABodyOfSixCentimetresIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  TriangleMesh tiny = test::load_shared_body("mh_female_average").surface;
  tiny.vertices *= 0.06 / 1.5898;
  EXPECT_EQ(code_of([&] { import_body(tiny, "tiny.obj", {.unit = LengthUnit::Metre}); }), ErrorCode::BodyUnusable);
  EXPECT_EQ(code_of([&] { import_body(tiny, "tiny.obj"); }), ErrorCode::BodyUnusable);
}

TEST(ImportBody, AFormIsTakenAsItStands) {
  TriangleMesh box = test::make_box(Vec3(-10, 5, -10), Vec3(10, 105, 10));
  const ImportBodyResult result = import_body(box, "box", {.kind = BodyKind::Form, .unit = LengthUnit::Centimetre});
  EXPECT_EQ(result.body.kind, BodyKind::Form);
  EXPECT_NEAR(result.body.surface.vertices.col(1).maxCoeff(), 1.0, 1e-12);
  EXPECT_NEAR(result.body.surface.vertices.col(1).minCoeff(), 0.0, 1e-12);
  EXPECT_FALSE(result.body.skeleton);
}

TEST(ImportBody, AnOpenFormIsClosedAndAnInsideOutOneTurned) {
  TriangleMesh sphere = test::make_sphere(0.4, 30, 40, Vec3(0, 0.4, 0));
  for (int f = 0; f < sphere.triangle_count(); ++f) std::swap(sphere.triangles(f, 0), sphere.triangles(f, 1));
  sphere.triangles = sphere.triangles.bottomRows(sphere.triangle_count() - 60).eval();
  const ImportBodyResult result = import_body(sphere, "ball", {.kind = BodyKind::Form, .unit = LengthUnit::Metre});
  EXPECT_GT(test::volume_of(result.body.surface), 0.2);
  EXPECT_GE(result.repairs.turned_triangles, 2340);
  EXPECT_EQ(result.repairs.holes.size(), 1u);
  EXPECT_GE(result.body.surface.vertices.col(1).minCoeff(), 0.0);
}

TEST(ImportBody, CancellationEndsTheStage) {
  std::atomic<bool> cancelled{true};
  Progress progress{.report = {}, .cancelled = &cancelled};
  EXPECT_EQ(code_of([&] { import_body(test::make_box(Vec3::Zero(), Vec3::Ones()), "box", {}, &progress); }),
            ErrorCode::Cancelled);
}

}  // namespace
}  // namespace toile
