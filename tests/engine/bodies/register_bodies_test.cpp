// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/register_bodies.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/bodies/body_bones.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/import_body.h"
#include "engine/bodies/make_builtin_body.h"
#include "engine/bodies/measure_body.h"
#include "engine/core/error.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/components.h"
#include "tests/support/registration/prepared_reference.h"
#include "tests/support/registration/registration_score.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/sidecar.h"

namespace toile {
namespace {

using test::RegistrationCase;
using test::RegistrationScore;

using test::reference;

struct Limits {
  double median, p95;  // mm
};

void expect_close(const std::string& from, const RegistrationCase& known, const Limits& limits) {
  const RegistrationReference& prepared = reference(from);
  const RegisterBodiesResult result = register_bodies(prepared, known.target);
  const RegistrationScore score = score_registration(result.map.mapped, prepared.weights, known, from, true);
  EXPECT_LT(score.median * 1e3, limits.median) << known.target.name;
  EXPECT_LT(score.p95 * 1e3, limits.p95) << known.target.name;
  EXPECT_LT(score.surface_mean * 1e3, 1.0) << known.target.name;
  EXPECT_LT(score.surface_p95 * 1e3, 2.5) << known.target.name;
  EXPECT_FALSE(result.map.exact);
}

Measurements measurements_of(const TriangleMesh& body) {
  return measure_body(body, find_skeleton(body).skeleton).measurements;
}

Body moved(const Body& body, const Mat3& turn) {
  Body out = body;
  out.surface.vertices = body.surface.vertices * turn.transpose();
  return out;
}

ErrorCode unregistered_with(const Body& target, std::string* message) {
  try {
    register_bodies(reference(test::kWoman), target);
  } catch (const Error& error) {
    *message = error.message;
    return error.code;
  }
  return ErrorCode::Internal;
}

TEST(RegisterBodies, TakesSharedTopologyAsExactAndSaysSo) {
  TOILE_REQUIRE_SHARED_DATA();
  const Body woman = test::load_shared_body(test::kWoman), man = test::load_shared_body("mh_male_average");
  const RegisterBodiesResult result = register_bodies(woman, man);
  EXPECT_TRUE(result.map.exact);
  EXPECT_EQ(std::get<std::string>(*result.diagnostics.find("method")), "shared_topology");
  EXPECT_TRUE(result.map.mapped == man.surface.vertices);
}

TEST(RegisterBodies, MapsABodyOntoItself) {
  TOILE_REQUIRE_SHARED_DATA();
  RegisterBodiesOptions options;
  options.use_shared_topology = false;
  for (const char* name : {test::kWoman, test::kMean}) {
    const Body body = test::load_shared_body(name);
    const RegisterBodiesResult result = register_bodies(body, body, options);
    EXPECT_FALSE(result.map.exact);
    std::vector<double> error;
    for (Eigen::Index v = 0; v < body.surface.vertices.rows(); ++v)
      error.push_back((result.map.mapped.row(v) - body.surface.vertices.row(v)).norm());
    EXPECT_LT(test::quantile(error, 0.95), 0.5e-3) << name;
  }
}

TEST(RegisterBodies, FindsTheCorrespondenceOfAHoledNoisyScan) {
  TOILE_REQUIRE_SHARED_DATA();
  expect_close(test::kWoman, test::scan_case("scan_a"), {10, 30});
}

TEST(RegisterBodies, GivesTheSameBytesAgain) {
  TOILE_REQUIRE_SHARED_DATA();
  const RegistrationCase known = test::shuffled_case("mh_child_8y");
  const auto a = register_bodies(reference(test::kWoman), known.target),
             b = register_bodies(reference(test::kWoman), known.target);
  EXPECT_TRUE(a.map.mapped == b.map.mapped);
}

TEST(RegisterBodies, LetsGivenLandmarksWin) {
  TOILE_REQUIRE_SHARED_DATA();
  const test::BodySidecar sidecar = test::load_body_sidecar(test::kWoman);
  const RegistrationCase known = test::shuffled_case("mh_male_average");
  RegistrationReference prepared = reference(test::kWoman);
  prepared.landmarks = sidecar.landmarks;
  const int vertex = sidecar.landmark_vertex.at("waist_l");
  const Vec3 truth = known.landmarks.at("waist_l");
  RegisterBodiesOptions options;
  const auto error = [&] {
    return (register_bodies(prepared, known.target, options).map.mapped.row(vertex).transpose() - truth).norm();
  };
  const double without = error();
  options.target_landmarks["waist_l"] = truth;
  EXPECT_GT(without, 5e-3);
  EXPECT_LT(error(), 2e-3);
}

// A scan that lost 6 mm of its soles stands too low by them; the reference knows how far soles are from ankles.
TEST(RegisterBodies, StandsAScanOnTheRegisteredSoles) {
  TOILE_REQUIRE_SHARED_DATA();
  Body target = test::shuffled_case("mh_female_athletic").target;
  const TriangleMesh whole = target.surface;
  std::vector<bool> keep(static_cast<std::size_t>(whole.triangle_count()));
  for (int f = 0; f < whole.triangle_count(); ++f) {
    const auto t = whole.triangles.row(f);
    keep[static_cast<std::size_t>(f)] =
        std::min({whole.vertices(t[0], 1), whole.vertices(t[1], 1), whole.vertices(t[2], 1)}) > 0.006;
  }
  target.surface = extract_triangles(whole, keep);
  const double lost = target.surface.vertices.col(1).minCoeff(), top = whole.vertices.col(1).maxCoeff();
  target.surface.vertices.col(1).array() -= lost;
  RegisterBodiesResult result = register_bodies(reference(test::kWoman), target);
  EXPECT_NEAR(stand_on_soles(target, result), lost, 2e-3);
  EXPECT_NEAR(target.surface.vertices.col(1).maxCoeff(), top, 2e-3);
  EXPECT_NEAR(result.map.mapped.col(1).minCoeff(), 0.0, 2.5e-3);  // the lowest vertex lies under the soles' quantile
}

// Modelled bodies have a mouth, teeth and all, that nothing can lie on.
TEST(RegisterBodies, LeavesOutWhatCannotBeSeenOfTheTarget) {
  TOILE_REQUIRE_SHARED_DATA();
  const Body mannequin = make_builtin_body("woman-38-168");
  const auto report = register_bodies(mannequin, test::load_shared_body("mh_female_heavy_short")).report;
  EXPECT_GT(report.scan_mean, 0.5e-3);
  EXPECT_LT(report.scan_p95, 5e-3);
  EXPECT_LT(report.scan_p99_without_hands, 15e-3);
}

TEST(RegisterBodies, RefusesABodyTurnedRound) {
  TOILE_REQUIRE_SHARED_DATA();
  const Body turned = moved(test::load_shared_body(test::kWoman),
                            Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()).toRotationMatrix());
  std::string message;
  EXPECT_EQ(unregistered_with(turned, &message), ErrorCode::RegistrationFailed) << message;
}

TEST(RegisterBodies, RefusesALyingBody) {
  TOILE_REQUIRE_SHARED_DATA();
  const Body lying = moved(test::load_shared_body(test::kWoman), turn_upright(UpAxis::PlusZ));
  std::string message;
  EXPECT_EQ(unregistered_with(lying, &message), ErrorCode::BodyNotRecognised) << message;
}

TEST(SlowRegisterBodies, FindsTheCorrespondenceOfEveryScan) {
  TOILE_REQUIRE_SHARED_DATA();
  expect_close(test::kMean, test::scan_case("scan_b"), {10, 20});
  expect_close(test::kWoman, test::scan_case("scan_d"), {12, 25});
  expect_close(test::kWoman, test::scan_case("scan_c"), {16, 45});
}

TEST(SlowRegisterBodies, FindsTheCorrespondenceWithinAFamily) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"ggg_mean_male", "ggg_male_extra", "ggg_small_female", "ggg_large_male"})
    expect_close(test::kMean, test::shuffled_case(name), {10, 20});
  for (const char* name : {"mh_female_thin_tall", "mh_female_heavy_short", "mh_child_8y"})
    expect_close(test::kWoman, test::shuffled_case(name), {12, 30});
  expect_close(test::kWoman, test::shuffled_case("mh_male_average"), {16, 45});
  expect_close(test::kWoman, test::shuffled_case("mh_male_old_heavy"), {16, 45});
}

constexpr double kThigh = 7e-3;  // m

void expect_girths(const std::string& from, const RegistrationCase& known) {
  const RegistrationReference& prepared = reference(from);
  const TriangleMesh registered{register_bodies(prepared, known.target).map.mapped, prepared.surface.triangles};
  const Measurements found = measurements_of(registered), truth = measurements_of(known.truth);
  for (const char* girth : {"waist_girth", "hip_girth", "bust_girth"})
    EXPECT_NEAR(found.at(girth), truth.at(girth), test::kLargeError) << known.target.name << " " << girth;
  EXPECT_NEAR(found.at("thigh_girth"), truth.at("thigh_girth"), kThigh) << known.target.name;
  for (const char* small : {"inside_leg_length", "knee_girth", "calf_girth"})
    EXPECT_NEAR(found.at(small), truth.at(small), test::kSmallError) << known.target.name << " " << small;
}

TEST(SlowRegisterBodies, KeepsTheGirthsOfTheTarget) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const char* name : {"mh_female_heavy_tall", "mh_male_old_heavy", "mh_child_8y"})
    expect_girths(test::kWoman, test::shuffled_case(name));
  for (const char* scan : {"scan_c", "scan_d"}) expect_girths(test::kWoman, test::scan_case(scan));
  expect_girths(test::kMean, test::scan_case("scan_b"));
}

// A nipple that is modelled on one body alone does not move the level of the bust.
TEST(SlowRegisterBodies, KeepsTheGirthsAcrossFamilies) {
  TOILE_REQUIRE_SHARED_DATA();
  expect_girths(test::kMean, test::shuffled_case(test::kWoman));
}

// Thighs that press on each other for centimetres under the crotch hide each other's skin.
TEST(SlowRegisterBodies, KeepsTheGirthsWhereThighsTouch) {
  TOILE_REQUIRE_SHARED_DATA();
  expect_girths(test::kMean, test::shuffled_case("ggg_male_extra"));
}

// The scanner has joined this heavy woman's thighs by a web 2 cm under the crotch, and the crotch itself is cut away.
TEST(SlowRegisterBodies, KeepsTheGirthsWhereAWebHidesTheCrotch) {
  TOILE_REQUIRE_SHARED_DATA();
  expect_girths(test::kWoman, test::scan_case("scan_a"));
}

TEST(SlowRegisterBodies, ComesBackFromTheOtherFamily) {
  TOILE_REQUIRE_SHARED_DATA();
  const RegistrationReference &a = reference(test::kMean), &b = reference(test::kWoman);
  Body other, own;
  other.surface = b.surface, own.surface = a.surface;
  const Points3 there = register_bodies(a, other).map.mapped, back = register_bodies(b, own).map.mapped;
  const SurfaceTree tree(b.surface.vertices, b.surface.triangles);
  std::vector<double> error;
  for (Eigen::Index v = 0; v < there.rows(); ++v) {
    if (a.weights(v, Head) + a.weights(v, Hand) + a.weights(v, Hand + 1) + a.weights(v, Foot) + a.weights(v, Foot + 1) >
        0.3)
      continue;
    const SurfacePoint c = tree.closest_point(there.row(v));
    Vec3 returned = Vec3::Zero();
    for (int k = 0; k < 3; ++k) returned += c.barycentric[k] * back.row(b.surface.triangles(c.triangle, k)).transpose();
    error.push_back((returned - a.surface.vertices.row(v).transpose()).norm());
  }
  EXPECT_LT(test::quantile(error, 0.95), 11e-3);
}

}  // namespace
}  // namespace toile
