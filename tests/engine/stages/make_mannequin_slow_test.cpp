// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "engine/geometry/closest_point.h"
#include "engine/geometry/half_edges.h"
#include "engine/stages/find_skeleton.h"
#include "engine/stages/make_mannequin.h"
#include "engine/stages/measure_body.h"
#include "tests/support/crossing_triangles.h"
#include "tests/support/random_people.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// Seeded people of the human range: every asked girth and length within 5 mm when measured on slices of the surface, no
// self-intersection, closed.
TEST(SlowMannequins, AHundredRandomPeopleMeetTheirTapeAndCrossNowhere) {
  constexpr double kTape = 5e-3;
  constexpr int kPeople = 100;
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

struct Likeness {
  const char* name;
  Figure figure;
};
constexpr std::array<Likeness, 15> kBodies = {{{"ggg_large_male", Figure::Man},
                                               {"ggg_male_extra", Figure::Man},
                                               {"ggg_mean_all", Figure::Person},
                                               {"ggg_mean_female", Figure::Woman},
                                               {"ggg_mean_male", Figure::Man},
                                               {"ggg_small_female", Figure::Woman},
                                               {"mh_child_8y", Figure::Child},
                                               {"mh_female_athletic", Figure::Woman},
                                               {"mh_female_average", Figure::Woman},
                                               {"mh_female_heavy_short", Figure::Woman},
                                               {"mh_female_heavy_tall", Figure::Woman},
                                               {"mh_female_thin_short", Figure::Woman},
                                               {"mh_female_thin_tall", Figure::Woman},
                                               {"mh_male_average", Figure::Man},
                                               {"mh_male_old_heavy", Figure::Man}}};

// What a tailor can tell of the true body.
Measurements tape_of(const Body& body) {
  const Skeleton skeleton = find_skeleton(body.surface).skeleton;
  const Measurements all = measure_body(body.surface, skeleton).measurements;
  Measurements tape;
  for (const char* name :
       {"height", "chest_girth", "waist_girth", "belly_girth", "hip_girth", "thigh_girth", "inside_leg_length"})
    tape[name] = all.at(name);
  return tape;
}

// Vertices of trunk and legs: no head, arms or feet.
Points3 trunk_and_legs(const Body& body, double height) {
  std::vector<int> chosen;
  for (int v = 0; v < body.surface.vertex_count(); ++v) {
    const double y = body.surface.vertices(v, 1) / height, x = std::abs(body.surface.vertices(v, 0)) / height;
    if (y > 0.05 && y < 0.82 && x < 0.105 + 0.5 * std::max(0.0, 0.76 - y)) chosen.push_back(v);
  }
  return body.surface.vertices(chosen, Eigen::all);
}

// The rigid motion of `from` that brings its points nearest to `to`, row by row.
void move_onto(Points3& from, const Points3& to) {
  const Eigen::RowVector3d a = from.colwise().mean(), b = to.colwise().mean();
  const Mat3 cross = (from.rowwise() - a).transpose() * (to.rowwise() - b);
  const Eigen::JacobiSVD<Mat3> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 flip = Mat3::Identity();
  flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  from = ((from.rowwise() - a) * (svd.matrixU() * flip * svd.matrixV().transpose())).rowwise() + b;
}

// Mean distance of the points to the surface after the best rigid motion, by iterated closest points.
double mean_distance(Points3 points, const TriangleMesh& mesh) {
  constexpr int kRounds = 20;
  const SurfaceTree tree(mesh.vertices, mesh.triangles);
  Points3 nearest(points.rows(), 3);
  std::vector<int> start(static_cast<std::size_t>(points.rows()), -1);
  double sum = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    sum = 0.0;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      int& near = start[static_cast<std::size_t>(i)];
      const SurfacePoint found =
          tree.closest_point(points.row(i).transpose(), std::numeric_limits<double>::infinity(), near);
      near = found.triangle;
      nearest.row(i) = found.point.transpose();
      sum += found.distance();
    }
    move_onto(points, nearest);
  }
  return sum / static_cast<double>(points.rows());
}

// Issue 9: "given only the tape measures of each of the 15 shared bodies, the mannequin's surface after best rigid
// alignment and arm pose is within 15 mm mean of the true one on trunk and legs". Arms are left out, so is their pose.
TEST(SlowMannequins, AreLikeThePersonWhoseTapeTheyWereMadeFrom) {
  TOILE_REQUIRE_SHARED_DATA();
  constexpr double kMostMean = 0.015, kLeastMean = 0.001;  // m; nearer than 1 mm would be the person himself
  double sum = 0.0;
  for (const Likeness& person : kBodies) {
    const Body body = test::load_shared_body(person.name);
    const Measurements tape = tape_of(body);
    const TriangleMesh mannequin = make_mannequin(tape, {.figure = person.figure}).body.surface;
    const double mean = mean_distance(trunk_and_legs(body, tape.at("height")), mannequin);
    EXPECT_LT(mean, kMostMean) << person.name;
    EXPECT_GT(mean, kLeastMean) << person.name;
    RecordProperty(person.name, std::to_string(mean));
    sum += mean;
  }
  constexpr double kUsualMean = 0.009;  // measured 7.7 mm
  EXPECT_LT(sum / kBodies.size(), kUsualMean);
}

}  // namespace
}  // namespace toile
