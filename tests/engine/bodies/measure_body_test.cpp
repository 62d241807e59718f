// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/measure_body.h"

#include <gtest/gtest.h>

#include "engine/bodies/find_skeleton.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"
#include "tests/support/sidecar.h"

namespace toile {
namespace {

// ISO 20685-1: what scanners are held to.

MeasureBodyResult measure(const TriangleMesh& body) {
  return measure_body(body, find_skeleton(body).skeleton);
}

TEST(MeasureBody, AgreesWithTheSidecarOfEveryBody) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const MeasureBodyResult result = measure(test::load_shared_body(name).surface);
    const auto truth = test::load_body_sidecar(name).measurements;
    const auto expect = [&](const char* ours, const char* theirs, double tolerance) {
      EXPECT_NEAR(result.measurements.at(ours), truth.at(theirs), tolerance) << name << " " << ours;
    };
    expect("height", "height", 1e-3);
    expect("inside_leg_length", "inseam", test::kSmallError);
    expect("thigh_girth_left", "thigh_left", test::kSmallError);
    expect("waist_girth", "waist", test::kLargeError);
    expect("hip_girth", "hips", test::kLargeError);
    expect("bust_girth", "bust_at_bust_points", test::kLargeError);
    expect("chest_girth", "chest_or_bust", test::kLargeError);
  }
}

TEST(MeasureBody, RepeatsOnTheMirroredBody) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_body_names()) {
    const TriangleMesh body = test::load_shared_body(name).surface;
    TriangleMesh mirrored = body;
    mirrored.vertices.col(0) *= -1;
    mirrored.triangles.col(1).swap(mirrored.triangles.col(2));
    const Measurements a = measure(body).measurements, b = measure(mirrored).measurements;
    for (const auto& [key, value] : a) {
      if (key == "thigh_girth_left" || key == "thigh_girth_right") continue;  // they swap
      EXPECT_NEAR(value, b.at(key), 1e-4) << name << " " << key;
      EXPECT_GT(value, 0.05) << name << " " << key;
    }
    EXPECT_NEAR(a.at("thigh_girth_left"), b.at("thigh_girth_right"), 1e-4) << name;
  }
}

TEST(MeasureBody, FindsEveryLandmarkNearItsPlace) {
  TOILE_REQUIRE_SHARED_DATA();
  std::map<std::string, std::vector<double>> errors;
  for (const std::string& name : test::shared_body_names()) {
    const Landmarks found = measure(test::load_shared_body(name).surface).landmarks;
    for (const auto& [key, truth] : test::load_body_sidecar(name).landmarks) {
      ASSERT_TRUE(found.contains(key)) << key;
      errors[key].push_back((found.at(key) - truth).norm());
    }
  }
  for (auto& [key, list] : errors) {
    std::sort(list.begin(), list.end());
    EXPECT_LT(list[list.size() / 2], 0.036) << key;
    EXPECT_LT(list.back(), 0.080) << key;
  }
}

TEST(MeasureBody, LetsGivenLandmarksWin) {
  TOILE_REQUIRE_SHARED_DATA();
  const TriangleMesh body = test::load_shared_body("mh_male_old_heavy").surface;
  const Landmarks given = {{"bust_l", Vec3(0.1, 1.19, 0.15)}, {"bust_r", Vec3(-0.1, 1.19, 0.15)}};
  const MeasureBodyResult result = measure_body(body, find_skeleton(body).skeleton, given);
  EXPECT_EQ(result.landmarks.at("bust_l"), given.at("bust_l"));
  EXPECT_EQ(result.levels.bust, 1.19);
  EXPECT_LT(result.measurements.at("bust_girth"), measure(body).measurements.at("bust_girth") - 0.01);
}

}  // namespace
}  // namespace toile
