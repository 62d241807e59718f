// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_zones.h"

namespace toile {
namespace {

constexpr double kArmpitInward = 0.86;  // x of the armpit over x of the shoulder joint, on bodies in A-pose
constexpr double kKneeBand = 0.12;      // half height of the knee zone, share of the crotch height

// Twice the signed area of (origin, along, p): > 0 where p lies to the left of the ray.
double side_of(const Vec2& origin, const Vec2& along, const Vec2& p) {
  const Vec2 rel = p - origin;
  return along.x() * rel.y() - along.y() * rel.x();
}

// Whether p lies on the arm's side of the ray that falls from the shoulder to the armpit and on between arm and trunk.
bool beyond_armpit(const Skeleton& skeleton, Side side, const Vec3& p) {
  const Skeleton::Arm& arm = skeleton.arms[side];
  const double sign = side == Left ? 1.0 : -1.0;
  const auto mirrored = [sign](const Vec3& v) { return Vec2(sign * v.x(), v.y()); };
  const Vec2 shoulder = mirrored(arm.shoulder), elbow = mirrored(arm.elbow), point = mirrored(p);
  const Vec2 armpit(kArmpitInward * shoulder.x(), skeleton.armpit_y);
  if (point.y() > armpit.y()) return side_of(armpit, shoulder - armpit, point) < 0.0;
  const Vec2 between = (elbow - shoulder).normalized() + Vec2(0.0, -1.0);
  return side_of(armpit, between, point) > 0.0;
}

BodyZone arm_zone(const Skeleton& skeleton, Side side, const Vec3& p) {
  const Skeleton::Arm& arm = skeleton.arms[side];
  const Vec3 along = arm.wrist - arm.shoulder;
  const bool upper = (p - arm.elbow).dot(along) < 0.0;
  if (side == Left) return upper ? BodyZone::LeftUpperArm : BodyZone::LeftForearm;
  return upper ? BodyZone::RightUpperArm : BodyZone::RightForearm;
}

BodyZone zone_by_height(const Skeleton& s, double y) {
  const double waist_half = 0.25 * (s.armpit_y - s.crotch_y) * 0.5;  // the waist zone is a quarter of the trunk
  const double knee = 0.5 * (s.legs[Left].knee.y() + s.legs[Right].knee.y());
  if (y > s.neck_y) return BodyZone::Neck;
  if (y > s.armpit_y) return BodyZone::Shoulders;
  if (y > s.waist_y + waist_half) return BodyZone::Chest;
  if (y > s.waist_y - waist_half) return BodyZone::Waist;
  if (y > s.crotch_y) return BodyZone::Hips;
  if (y > knee + kKneeBand * s.crotch_y) return BodyZone::Thighs;
  return y > knee - kKneeBand * s.crotch_y ? BodyZone::Knees : BodyZone::Calves;
}

BodyZone zone_of(const Skeleton& skeleton, const std::string& label, const Vec3& p) {
  const Side side = p.x() >= 0.0 ? Left : Right;
  const bool may_be_arm = label.empty() || label == "arm";
  if (label == "arm" || (may_be_arm && beyond_armpit(skeleton, side, p))) return arm_zone(skeleton, side, p);
  return zone_by_height(skeleton, p.y());
}

}  // namespace

std::string_view zone_name(BodyZone zone) {
  switch (zone) {
    case BodyZone::Whole: return "whole";
    case BodyZone::Neck: return "neck";
    case BodyZone::Shoulders: return "shoulders";
    case BodyZone::Chest: return "chest";
    case BodyZone::Waist: return "waist";
    case BodyZone::Hips: return "hips";
    case BodyZone::Thighs: return "thighs";
    case BodyZone::Knees: return "knees";
    case BodyZone::Calves: return "calves";
    case BodyZone::LeftUpperArm: return "left_upper_arm";
    case BodyZone::RightUpperArm: return "right_upper_arm";
    case BodyZone::LeftForearm: return "left_forearm";
    case BodyZone::RightForearm: return "right_forearm";
  }
  return "";
}

std::vector<BodyZone> body_zones(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape,
                                 const Body& body) {
  std::vector<BodyZone> zones(static_cast<std::size_t>(mesh.triangle_count()), BodyZone::Whole);
  if (!body.skeleton) return zones;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i nodes = mesh.nodes_of_triangle(f);
    const Vec3 middle = (drape.nodes.row(nodes[0]) + drape.nodes.row(nodes[1]) + drape.nodes.row(nodes[2])) / 3.0;
    const auto panel = static_cast<std::size_t>(mesh.panel_of_triangle[static_cast<std::size_t>(f)]);
    zones[static_cast<std::size_t>(f)] = zone_of(*body.skeleton, pattern.panels[panel].label, middle);
  }
  return zones;
}

}  // namespace toile
