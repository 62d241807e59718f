// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/leg_profile.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/make_mannequin.h"

namespace toile {
namespace {

const TriangleMesh& woman() {
  static const TriangleMesh surface = make_mannequin({{"height", 1.68}}, {.figure = Figure::Woman}).body.surface;
  return surface;
}

LegProfile profile_of(const TriangleMesh& body) {
  return find_leg_profile(body, find_skeleton(body).skeleton);
}

double slid(double level) {
  return level + 0.035 * std::sin(std::numbers::pi * level);
}

// The same body with its calves, knees and thighs further up; soles and crotch stay.
TriangleMesh with_legs_slid(TriangleMesh body) {
  const double crotch = find_skeleton(body).skeleton.crotch_y;
  for (Eigen::Index v = 0; v < body.vertices.rows(); ++v)
    if (double& y = body.vertices(v, 1); y < crotch && std::abs(body.vertices(v, 0)) < 0.25)
      y = crotch * slid(y / crotch);
  return body;
}

// Without what lies within `reach` of a point.
TriangleMesh with_hole(const TriangleMesh& body, const Vec3& at, double reach) {
  TriangleMesh holed{body.vertices, Triangles(body.triangles.rows(), 3)};
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < body.triangles.rows(); ++f)
    if ((body.vertices.row(body.triangles(f, 0)).transpose() - at).norm() > reach)
      holed.triangles.row(kept++) = body.triangles.row(f);
  holed.triangles.conservativeResize(kept, 3);
  return holed;
}

TEST(LegProfile, MatchesALegWithItself) {
  const LegProfile profile = profile_of(woman());
  const LegLevels levels(profile, profile);
  for (double level = 0.0; level < 1.1; level += 0.05) EXPECT_NEAR(levels(level), level, 1e-12);
}

TEST(LegProfile, FindsHowFarCalvesAndThighsAreUp) {
  const LegLevels levels(profile_of(woman()), profile_of(with_legs_slid(woman())));
  for (double level = 0.15; level < 0.95; level += 0.05) EXPECT_NEAR(levels(level), slid(level), 0.012) << level;
  EXPECT_NEAR(levels(1.02), 1.02, 0.006);
  EXPECT_EQ(levels(1.4), 1.4);
  EXPECT_EQ(levels(0.0), 0.0);
}

TEST(LegProfile, LeavesOutWhatAScanDoesNotShow) {
  TriangleMesh slid_body = with_legs_slid(woman());
  const Skeleton skeleton = find_skeleton(slid_body).skeleton;
  const LegProfile whole = find_leg_profile(slid_body, skeleton);
  for (const Side side : {Left, Right}) {
    const Skeleton::Leg& leg = skeleton.legs[side];
    slid_body = with_hole(slid_body, 0.5 * (leg.knee + leg.hip) + Vec3(0, 0, 0.09), 0.06);
    slid_body = with_hole(slid_body, leg.ankle, 0.07);
  }
  const LegProfile holed = find_leg_profile(slid_body, skeleton);
  EXPECT_FALSE(whole.lean.hasNaN());
  EXPECT_TRUE(holed.lean.hasNaN());
  const LegLevels levels(profile_of(woman()), holed);
  for (double level = 0.2; level < 0.95; level += 0.05) EXPECT_NEAR(levels(level), slid(level), 0.02) << level;
}

}  // namespace
}  // namespace toile
