// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_zones.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

// A person of 1.70 m in A-pose, in round numbers.
Body person() {
  Body body;
  Skeleton& s = body.skeleton.emplace();
  s.height = 1.70, s.crotch_y = 0.78, s.armpit_y = 1.28, s.waist_y = 1.08, s.neck_y = 1.46;
  for (const Side side : {Left, Right}) {
    const double sign = side == Left ? 1.0 : -1.0;
    s.arms[side].shoulder = {sign * 0.18, 1.40, 0.0};
    s.arms[side].elbow = {sign * 0.36, 1.17, 0.0};
    s.arms[side].wrist = {sign * 0.52, 0.97, 0.0};
    s.legs[side].knee = {sign * 0.1, 0.46, 0.0};
  }
  return body;
}

// The zone of one small triangle of a panel with this label, worn at p.
BodyZone zone_at(const Vec3& p, const std::string& label = "") {
  Pattern pattern;
  pattern.panels.resize(1);
  pattern.panels[0].label = label;
  PatternMesh mesh;
  mesh.rest = Points2::Zero(3, 2);
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  mesh.panel_of_triangle = {0};
  mesh.node_of_vertex = {0, 1, 2};
  mesh.node_count = 3;
  Drape drape;
  drape.nodes = p.transpose().replicate(3, 1);
  return body_zones(pattern, mesh, drape, person()).front();
}

TEST(BodyZones, FollowTheHeightOnTheTrunkAndLegs) {
  EXPECT_EQ(zone_at({0, 1.50, 0.1}), BodyZone::Neck);
  EXPECT_EQ(zone_at({0.05, 1.40, 0.1}), BodyZone::Shoulders);
  EXPECT_EQ(zone_at({0.05, 1.22, 0.1}), BodyZone::Chest);
  EXPECT_EQ(zone_at({0.12, 1.08, 0.0}), BodyZone::Waist);
  EXPECT_EQ(zone_at({-0.17, 0.90, 0.0}), BodyZone::Hips);
  EXPECT_EQ(zone_at({0.1, 0.65, 0.0}), BodyZone::Thighs);
  EXPECT_EQ(zone_at({0.1, 0.46, 0.0}), BodyZone::Knees);
  EXPECT_EQ(zone_at({0.1, 0.20, 0.0}), BodyZone::Calves);
}

TEST(BodyZones, TellArmsFromTheTrunkBesideThem) {
  EXPECT_EQ(zone_at({0.27, 1.28, 0.0}), BodyZone::LeftUpperArm);
  EXPECT_EQ(zone_at({-0.27, 1.28, 0.0}), BodyZone::RightUpperArm);
  EXPECT_EQ(zone_at({-0.45, 1.06, 0.0}), BodyZone::RightForearm);
  EXPECT_EQ(zone_at({0.15, 1.20, 0.0}), BodyZone::Chest);
  EXPECT_EQ(zone_at({0.30, 0.85, 0.0}, "leg"), BodyZone::Hips);  // a wide skirt below the hand is no sleeve
  EXPECT_EQ(zone_at({0.17, 1.35, 0.0}, "arm"), BodyZone::LeftUpperArm);
}

}  // namespace
}  // namespace toile
