// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/find_skeleton.h"

#include <random>

#include <gtest/gtest.h>

#include "engine/bodies/normalise_body.h"
#include "engine/core/error.h"
#include "engine/geometry/components.h"
#include "engine/geometry/surface_operators.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

using test::load_shared_body;

// The triangles all of whose corners satisfy `keep`.
template <class Keep>
TriangleMesh cut(const TriangleMesh& mesh, Keep keep) {
  std::vector<bool> kept(static_cast<std::size_t>(mesh.triangle_count()));
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    bool all = true;
    for (int k = 0; k < 3; ++k) all &= keep(Vec3(mesh.vertices.row(mesh.triangles(f, k))));
    kept[static_cast<std::size_t>(f)] = all;
  }
  return extract_triangles(mesh, kept);
}

std::string why_not_found(const TriangleMesh& mesh) {
  try {
    find_skeleton(mesh);
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::BodyNotRecognised);
    return error.message;
  }
  return {};
}

TEST(FindSkeleton, FindsEverySharedBodyInUsualProportions) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const FindSkeletonResult result = find_skeleton(load_shared_body(name).surface);
    const Skeleton& s = result.skeleton;
    EXPECT_TRUE(result.warnings.empty()) << name;
    EXPECT_NEAR(s.arms[Left].length, s.arms[Right].length, 0.015 * s.height) << name;
    EXPECT_LT(s.legs[Right].ankle.x(), -0.03) << name;
    EXPECT_GT(s.legs[Left].knee.x(), 0.03) << name;
    EXPECT_GT(s.arms[Left].wrist.x(), s.arms[Left].elbow.x()) << name;
    EXPECT_GT(s.arms[Left].shoulder.y(), s.arms[Left].elbow.y()) << name;
    EXPECT_GT(s.legs[Left].toe.z(), s.legs[Left].ankle.z() + 0.05) << name;
  }
}

// Noise makes every way along edges longer, in a hand's fine triangles more than along the arm.
TEST(FindSkeleton, FindsElbowsAndWristsUnderNoise) {
  TOILE_REQUIRE_SHARED_DATA();
  constexpr double kSpread = 0.0035, kNear = 0.022;  // m: a sigma of 2 mm; unsmoothed, wrists lie 48 mm off
  TriangleMesh body = load_shared_body("mh_female_average").surface;
  const Skeleton clean = find_skeleton(body).skeleton;
  const Points3 normals = vertex_normals(body.vertices, body.triangles);
  std::mt19937 random(1);
  for (Eigen::Index v = 0; v < body.vertices.rows(); ++v)
    body.vertices.row(v) += kSpread * (static_cast<double>(random()) / 2147483648.0 - 1.0) * normals.row(v);
  const Skeleton noisy = find_skeleton(body).skeleton;
  for (const Side side : {Left, Right}) {
    EXPECT_LT((noisy.arms[side].elbow - clean.arms[side].elbow).norm(), kNear);
    EXPECT_LT((noisy.arms[side].wrist - clean.arms[side].wrist).norm(), kNear);
  }
}

TEST(FindSkeleton, MirrorsWithTheBody) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = load_shared_body("ggg_mean_female").surface;
  TriangleMesh mirrored = body;
  mirrored.vertices.col(0) *= -1;
  mirrored.triangles.col(1).swap(mirrored.triangles.col(2));
  const Skeleton a = find_skeleton(body).skeleton, b = find_skeleton(mirrored).skeleton;
  EXPECT_NEAR(a.crotch_y, b.crotch_y, 1e-9);
  EXPECT_NEAR(a.armpit_y, b.armpit_y, 1e-9);
  const Vec3 flip(-1, 1, 1);
  for (const Side side : {Left, Right}) {
    const Side other = side == Left ? Right : Left;
    EXPECT_LT((a.arms[side].elbow.cwiseProduct(flip) - b.arms[other].elbow).norm(), 1e-6);
    EXPECT_LT((a.legs[side].knee.cwiseProduct(flip) - b.legs[other].knee).norm(), 1e-6);
  }
}

TEST(FindSkeleton, StandsHolesAndNoise) {
  TOILE_REQUIRE_SHARED_DATA();
  const std::pair<const char*, const char*> pairs[] = {{"scan_a", "mh_female_heavy_tall"},
                                                       {"scan_b", "ggg_large_male"},
                                                       {"scan_c", "mh_male_old_heavy"},
                                                       {"scan_d", "mh_child_8y"}};
  for (const auto& [scan, source] : pairs) {
    const Skeleton s = find_skeleton(normalise_body(test::load_shared_scan(scan)).surface).skeleton;
    const Skeleton truth = find_skeleton(load_shared_body(source).surface).skeleton;
    EXPECT_NEAR(s.crotch_y, truth.crotch_y, 0.03) << scan;
    EXPECT_NEAR(s.armpit_y, truth.armpit_y, 0.02) << scan;
    EXPECT_LT(std::abs(s.chest.x()), 0.02) << scan;
    EXPECT_NEAR(s.legs[Left].hip.y(), truth.legs[Left].hip.y(), 0.03) << scan;
  }
}

TEST(FindSkeleton, RefusesABodyWithoutHead) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh whole = load_shared_body("mh_male_average").surface;
  EXPECT_FALSE(why_not_found(cut(whole, [](const Vec3& p) { return p.y() < 1.46; })).empty());
}

TEST(FindSkeleton, RefusesABodyWithOneArm) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh whole = load_shared_body("mh_female_average").surface;
  EXPECT_NE(why_not_found(cut(whole, [](const Vec3& p) { return p.x() < 0.24; })).find("arm"), std::string::npos);
}

TEST(FindSkeleton, RefusesHalfABodyAndOneUpsideDown) {
  TOILE_REQUIRE_SHARED_DATA();
  TriangleMesh body = load_shared_body("mh_female_average").surface;
  TriangleMesh upper = cut(body, [](const Vec3& p) { return p.y() > 0.8; });
  upper.vertices.col(1).array() -= upper.vertices.col(1).minCoeff();
  EXPECT_FALSE(why_not_found(upper).empty());
  body.vertices.col(1) = body.vertices.col(1).maxCoeff() - body.vertices.col(1).array();
  EXPECT_FALSE(why_not_found(body).empty());
}

}  // namespace
}  // namespace toile
