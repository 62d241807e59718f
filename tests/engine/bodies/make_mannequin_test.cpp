// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/make_mannequin.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/make_builtin_body.h"
#include "engine/bodies/mannequin_proportions.h"
#include "engine/bodies/measure_body.h"
#include "engine/core/error.h"
#include "engine/geometry/half_edges.h"
#include "tests/support/crossing_triangles.h"

namespace toile {
namespace {

constexpr double kTape = 5e-3;  // m: what a tape measure in a shop can tell

double volume(const TriangleMesh& mesh) {
  double six = 0.0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, 1)),
               c = mesh.vertices.row(mesh.triangles(t, 2));
    six += a.dot(b.cross(c));
  }
  return six / 6.0;
}

TEST(MakeMannequin, ASurfaceIsClosedTwoManifoldAndOutward) {
  const Body body = make_builtin_body("woman-38-168");
  EXPECT_TRUE(find_defects(body.surface.vertex_count(), body.surface.triangles).none());
  EXPECT_EQ(body.surface.vertex_count() - body.surface.triangle_count() / 2, 2);  // Euler: a sphere, no handles
  EXPECT_GT(volume(body.surface), 0.045);                                         // m^3 of a slim adult
  EXPECT_LT(volume(body.surface), 0.070);
  EXPECT_TRUE(test::crossing_triangles(body.surface).empty());
}

TEST(MakeMannequin, StandsOnTheFloorAsTallAsAskedAndSymmetric) {
  const Body body = make_builtin_body("man-50-178");
  const Points3& v = body.surface.vertices;
  EXPECT_EQ(v.col(1).minCoeff(), 0.0);
  EXPECT_NEAR(v.col(1).maxCoeff(), 1.78, 1e-12);
  EXPECT_EQ(v.col(0).minCoeff(), -v.col(0).maxCoeff());
  EXPECT_NEAR(v.col(0).sum(), 0.0, 1e-9);
}

TEST(MakeMannequin, AskedMeasurementsAreMetOnTheSurface) {
  const Measurements asked = {{"height", 1.72},      {"bust_girth", 0.98},      {"underbust_girth", 0.84},
                              {"waist_girth", 0.80}, {"hip_girth", 1.05},       {"thigh_girth", 0.62},
                              {"calf_girth", 0.38},  {"neck_girth", 0.35},      {"inside_leg_length", 0.80},
                              {"knee_girth", 0.39},  {"upper_arm_girth", 0.30}, {"wrist_girth", 0.165}};
  const Body body = make_mannequin(asked, {.figure = Figure::Woman}).body;
  const Skeleton found = find_skeleton(body.surface).skeleton;  // nothing the generator knew but the marked bust
  const Landmarks bust = {{"bust_l", body.landmarks.at("bust_l")}, {"bust_r", body.landmarks.at("bust_r")}};
  const Measurements taken = measure_body(body.surface, found, bust).measurements;
  for (const auto& [name, value] : asked) EXPECT_NEAR(taken.at(name), value, kTape) << name;
}

TEST(MakeMannequin, TheKnownSkeletonIsTheOneFoundOnItsSurface) {
  const Body body = make_builtin_body("woman-42-168");
  const Skeleton& known = *body.skeleton;
  const Skeleton found = find_skeleton(body.surface).skeleton;
  constexpr double kDetector = 0.02;  // m: how well the detector finds a level or a joint
  EXPECT_NEAR(known.crotch_y, found.crotch_y, kDetector);
  EXPECT_NEAR(known.armpit_y, found.armpit_y, kDetector);
  EXPECT_NEAR(known.neck_y, found.neck_y, kDetector);
  EXPECT_LT((known.waist - found.waist).norm(), kDetector);
  for (const Side side : {Left, Right}) {
    EXPECT_LT((known.legs[side].knee - found.legs[side].knee).norm(), kDetector);
    EXPECT_LT((known.arms[side].elbow - found.arms[side].elbow).norm(), 2 * kDetector);
    EXPECT_LT((known.arms[side].wrist - found.arms[side].wrist).norm(), 2 * kDetector);
    EXPECT_NEAR(known.arms[side].length, found.arms[side].length, 2 * kDetector);
  }
}

TEST(MakeMannequin, AllMannequinsShareTheirTriangles) {
  const Body child = make_builtin_body("child-128"), woman = make_builtin_body("woman-50-172");
  EXPECT_EQ(child.surface.triangles, woman.surface.triangles);
  EXPECT_GT((child.surface.vertices - woman.surface.vertices).rowwise().norm().maxCoeff(), 0.2);
}

TEST(MakeMannequin, TheSameMeasurementsGiveTheSameBytes) {
  const Measurements asked = {{"height", 1.6}, {"waist_girth", 0.75}};
  EXPECT_EQ(make_mannequin(asked).body.surface.vertices, make_mannequin(asked).body.surface.vertices);
}

TEST(MakeMannequin, WhatIsNotAskedIsCompletedFromTheBuild) {
  const Measurements slim = complete_measurements({{"height", 1.68}, {"bust_girth", 0.80}}, Figure::Woman);
  const Measurements stout = complete_measurements({{"height", 1.68}, {"bust_girth", 1.10}}, Figure::Woman);
  EXPECT_NEAR(complete_measurements({{"bust_girth", 0.88}}, Figure::Woman).at("waist_girth"), 0.72, 1e-9);
  EXPECT_LT(slim.at("waist_girth") + 0.2, stout.at("waist_girth"));
  EXPECT_LT(slim.at("thigh_girth") + 0.1, stout.at("thigh_girth"));
  EXPECT_EQ(slim.at("inside_leg_length"), stout.at("inside_leg_length"));
  EXPECT_FALSE(complete_measurements({{"chest_girth", 0.9}}, Figure::Woman).contains("bust_girth"));
}

TEST(MakeMannequin, AWaistAsWideAsHipAndChestIsMetWithoutABellyOverThem) {
  const Measurements asked = {{"height", 1.683}, {"chest_girth", 1.094}, {"waist_girth", 1.023}, {"hip_girth", 1.033}};
  const Measurements taken = make_mannequin(asked, {.figure = Figure::Man}).body.measurements;
  for (const auto& [name, value] : asked) EXPECT_NEAR(taken.at(name), value, kTape) << name;
  EXPECT_LT(taken.at("belly_girth"), 1.10);
}

void expect_refused(const Measurements& asked, const std::string& subject) {
  try {
    make_mannequin(asked);
    FAIL() << subject;
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::OptionInvalid);
    EXPECT_EQ(error.subject, subject);
  }
}

TEST(MakeMannequin, RefusesWhatNoPersonMeasures) {
  expect_refused({{"waist", 0.8}}, "measurements/waist");
  expect_refused({{"height", 168.0}}, "measurements/height");
  expect_refused({{"height", std::nan("")}}, "measurements/height");
  expect_refused({{"waist_girth", 72.0}}, "measurements/waist_girth");
  expect_refused({{"hip_girth", -1.0}}, "measurements/hip_girth");
  expect_refused({{"waist_girth", 0.9}, {"belly_girth", 0.7}}, "measurements/belly_girth");
  expect_refused({{"waist_girth", 1.06}, {"hip_girth", 1.03}}, "measurements/hip_girth");
  expect_refused({{"waist_girth", 0.9}, {"chest_girth", 0.88}}, "measurements/chest_girth");
}

TEST(MakeBuiltinBody, KnowsWomenMenChildrenAndForms) {
  EXPECT_NEAR(make_builtin_body("woman-32-160").measurements.at("bust_girth"), 0.76, kTape);
  EXPECT_NEAR(make_builtin_body("man-58-185").measurements.at("waist_girth"), 1.07, kTape);
  EXPECT_NEAR(make_builtin_body("child-98").measurements.at("height"), 0.98, 1e-9);
  EXPECT_EQ(make_builtin_body("tube-14-100").kind, BodyKind::Form);
}

TEST(MakeBuiltinBody, NamesWhatIsKnownWhenAskedForSomethingElse) {
  for (const char* name :
       {"", "woman", "woman-38", "woman-39-168", "woman-38-1680", "man-50-", "child-300", "child-1e2"}) {
    try {
      make_builtin_body(name);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ErrorCode::NotFound);
      EXPECT_NE(error.message.find("woman-38-168"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace toile
