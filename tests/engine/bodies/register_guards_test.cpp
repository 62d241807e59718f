// SPDX-License-Identifier: GPL-3.0-or-later
// What is no whole upright person is refused with its reason, on the whole way from file to map: never a silently
// wrong map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/bodies/import_body.h"
#include "engine/bodies/register_bodies.h"
#include "engine/core/error.h"
#include "engine/geometry/components.h"
#include "tests/support/registration/posed_body.h"
#include "tests/support/registration/prepared_reference.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/solids.h"

namespace toile {
namespace {

using test::reference;

template <class Keep>
TriangleMesh kept(const TriangleMesh& mesh, Keep keep) {
  std::vector<bool> stays(static_cast<std::size_t>(mesh.triangle_count()), true);
  for (int f = 0; f < mesh.triangle_count(); ++f)
    for (int k = 0; k < 3; ++k)
      if (!keep(Vec3(mesh.vertices.row(mesh.triangles(f, k))))) stays[static_cast<std::size_t>(f)] = false;
  return extract_triangles(mesh, stays);
}

// The reason of the refusal; empty where a map came out.
std::string why_not_registered(const TriangleMesh& file, const char* from = test::kMean) {
  try {
    const ImportBodyResult target = import_body(file, "target");
    register_bodies(reference(from), without_patches(target.body, target.repairs.added_triangles()));
  } catch (const Error& error) {
    EXPECT_TRUE(error.code == ErrorCode::BodyNotRecognised || error.code == ErrorCode::RegistrationFailed)
        << error.message;
    EXPECT_GT(error.message.size(), 40U);
    return error.message;
  }
  return {};
}

TriangleMesh average_woman() {
  return test::load_shared_body(test::kWoman).surface;
}

TEST(RegisterGuards, ABodyWithoutHeadIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = average_woman();
  const double top = 0.86 * body.vertices.col(1).maxCoeff();
  EXPECT_NE(why_not_registered(kept(body, [&](const Vec3& p) { return p.y() < top; })), "");
}

TEST(RegisterGuards, ABodyWithOneArmIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const double cut : {0.22, 0.40})  // at the upper arm, at the forearm
    EXPECT_NE(why_not_registered(kept(average_woman(), [&](const Vec3& p) { return p.x() < cut; })), "") << cut;
}

TEST(RegisterGuards, HalfABodyIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  EXPECT_NE(why_not_registered(kept(average_woman(), [](const Vec3& p) { return p.y() > 0.8; })), "");
  EXPECT_NE(why_not_registered(kept(average_woman(), [](const Vec3& p) { return p.y() < 0.9; })), "");
  EXPECT_NE(why_not_registered(kept(average_woman(), [](const Vec3& p) { return p.x() > 0.0; })), "");
}

TEST(RegisterGuards, TwoPeopleAreRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh one = average_woman();
  TriangleMesh two = one;
  two.vertices.resize(2 * one.vertex_count(), 3);
  two.vertices << one.vertices, one.vertices.rowwise() + Eigen::RowVector3d(1.3, 0, 0);
  two.triangles.resize(2 * one.triangle_count(), 3);
  two.triangles << one.triangles, (one.triangles.array() + one.vertex_count()).matrix();
  EXPECT_THAT(why_not_registered(two), testing::HasSubstr("one"));
}

TEST(RegisterGuards, ACubeIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  EXPECT_NE(why_not_registered(test::make_box(Vec3::Zero(), Vec3::Constant(1.7))), "");
}

TEST(RegisterGuards, ASittingPersonIsRefused) {
  TOILE_REQUIRE_SHARED_DATA();
  TriangleMesh body = average_woman();
  body.vertices = test::posed(body, {.arms = 0, .forearms = 0, .feet_apart = 0, .hips = 85, .knees = 85});
  EXPECT_NE(why_not_registered(body, test::kWoman), "");
}

// Lying on its back or standing on its head in the file, a body is put right, and the map is no worse for it.
TEST(RegisterGuards, LyingAndUpsideDownBodiesArePutRight) {
  TOILE_REQUIRE_SHARED_DATA();
  TriangleMesh body = test::load_shared_body("mh_female_athletic").surface;
  for (const UpAxis up : {UpAxis::MinusZ, UpAxis::MinusY}) {
    TriangleMesh file = body;
    file.vertices = body.vertices * turn_upright(up);
    const ImportBodyResult target = import_body(file, "target");
    const RegisterBodiesResult result = register_bodies(reference(test::kWoman), target.body);
    std::vector<double> error;
    for (Eigen::Index v = 0; v < body.vertices.rows(); ++v)
      error.push_back((result.map.mapped.row(v) - target.body.surface.vertices.row(v)).norm());
    EXPECT_LT(test::quantile(error, 0.5), 12e-3);
  }
}

struct Variant {
  const char* reference;
  const char* body;
  unsigned seed;
  double median, p95, landmarks = 15.6;  // mm, 1.3 times the gates of the shared scans
};

class SlowRegisterVariants : public testing::TestWithParam<Variant> {};

TEST_P(SlowRegisterVariants, StaysNearTheGatesOfTheSharedScans) {
  TOILE_REQUIRE_SHARED_DATA();
  const Variant& v = GetParam();
  const test::RegistrationCase known = test::variant_case(v.body, v.seed);
  const RegistrationReference& prepared = reference(v.reference);
  const RegisterBodiesResult result = register_bodies(prepared, known.target);
  const auto score = score_registration(result.map.mapped, prepared.weights, known, v.reference, true);
  EXPECT_LT(score.median * 1e3, v.median);
  EXPECT_LT(score.p95 * 1e3, v.p95);
  EXPECT_LT(score.landmark_median * 1e3, v.landmarks);
  EXPECT_LT(score.surface_mean * 1e3, 1.3);
  EXPECT_LT(score.surface_p95 * 1e3, 3.25);
}

INSTANTIATE_TEST_SUITE_P(Bodies, SlowRegisterVariants,
                         testing::Values(Variant{test::kMean, "ggg_mean_female", 101, 13, 26},
                                         Variant{test::kMean, "ggg_large_male", 102, 13, 26},
                                         Variant{test::kWoman, "mh_female_heavy_short", 103, 15.6, 39},
                                         Variant{test::kWoman, "mh_child_8y", 104, 15.6, 39},
                                         Variant{test::kWoman, "mh_female_thin_tall", 37, 15.6, 39},
                                         Variant{test::kWoman, "mh_female_heavy_tall", 32, 15.6, 39},
                                         Variant{test::kWoman, "mh_male_average", 105, 20.8, 58.5, 33.8},
                                         Variant{test::kWoman, "mh_male_old_heavy", 37, 20.8, 58.5, 33.8},
                                         Variant{test::kWoman, "mh_male_old_heavy", 38, 20.8, 58.5, 33.8}));

}  // namespace
}  // namespace toile
