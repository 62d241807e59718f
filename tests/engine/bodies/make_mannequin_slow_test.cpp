// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "engine/bodies/make_mannequin.h"
#include "engine/bodies/measure_body.h"
#include "engine/geometry/half_edges.h"
#include "tests/support/crossing_triangles.h"
#include "tests/support/likeness.h"
#include "tests/support/random_people.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// Seeded people of the human range: every asked girth and length within 5 mm when measured on slices of the surface, no
// self-intersection, closed.
TEST(SlowMannequins, FiveHundredRandomPeopleMeetTheirTapeAndCrossNowhere) {
  constexpr double kTape = 5e-3;
  constexpr int kPeople = 500;
  int asked_measurements = 0;
  for (int number = 0; number < kPeople; ++number) {
    const test::RandomPerson person = test::random_person(number);
    const Body body = make_mannequin(person.asked, {.figure = person.figure}).body;
    ASSERT_TRUE(find_defects(body.surface.vertex_count(), body.surface.triangles).none());
    EXPECT_TRUE(test::crossing_triangles(body.surface).empty()) << "person " << number;
    Landmarks bust_points = {{"bust_l", body.landmarks.at("bust_l")}, {"bust_r", body.landmarks.at("bust_r")}};
    const Measurements taken = measure_body(body.surface, *body.skeleton, bust_points).measurements;
    for (const auto& [name, value] : person.asked) {
      EXPECT_NEAR(taken.at(name), value, kTape) << name << " of person " << number;
      ++asked_measurements;
    }
  }
  EXPECT_GT(asked_measurements, 4 * kPeople);
}

// Issue 9: "given only the tape measures of each of the 15 shared bodies, the mannequin's surface after best rigid
// alignment and arm pose is within 15 mm mean of the true one on trunk and legs". Arms are left out, so is their pose.
TEST(SlowMannequins, AreLikeThePersonWhoseTapeTheyWereMadeFrom) {
  TOILE_REQUIRE_SHARED_DATA();
  constexpr double kMostMean = 0.015, kLeastMean = 0.001;  // m; nearer than 1 mm would be the person himself
  double sum = 0.0;
  for (const test::SharedPerson& person : test::kSharedPeople) {
    const double mean = test::mannequin_of(person).mean;
    EXPECT_LT(mean, kMostMean) << person.name;
    EXPECT_GT(mean, kLeastMean) << person.name;
    RecordProperty(person.name, std::to_string(mean));
    sum += mean;
  }
  constexpr double kUsualMean = 0.009;  // measured 7.7 mm
  EXPECT_LT(sum / test::kSharedPeople.size(), kUsualMean);
}

}  // namespace
}  // namespace toile
