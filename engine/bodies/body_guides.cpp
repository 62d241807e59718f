// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/body_guides.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/bodies/body_slices.h"

namespace toile {
namespace {

constexpr double kLegStep = 0.02, kLegReach = 0.14, kSole = 0.03;  // m
constexpr double kShoulderStep = 0.005, kShoulderLimit = 0.25;     // m
constexpr double kArmCut = 0.16;  // m below the shoulder joint along the arm: clear of the trunk on every body tried

// Height at which a vertical line from inside the body leaves it.
double top_above(const SurfaceTree& surface, Vec3 p) {
  const double limit = p.y() + kShoulderLimit;
  while (p.y() < limit && surface.winding_number(p) > 0) p.y() += kShoulderStep;
  return p.y() - 0.5 * kShoulderStep;
}

Vec3 on_polyline_at_height(const std::vector<Vec3>& line, double y) {
  std::size_t k = 1;
  while (k + 1 < line.size() && line[k].y() > y) ++k;
  const Vec3 &a = line[k - 1], &b = line[k];
  const double drop = a.y() - b.y();
  const double t = std::abs(drop) > 1e-9 ? std::clamp((a.y() - y) / drop, 0.0, 1.0) : 0.0;
  Vec3 p = a + t * (b - a);
  p.y() = y;
  return p;
}

// Middles of the boxes of the leg's slices, every 2 cm; the joint line where a slice is empty.
std::vector<Vec3> leg_line(const BodySlices& slices, const Skeleton& skeleton, Side side) {
  const Skeleton::Leg& leg = skeleton.legs[side];
  const std::vector<Vec3> joints = {leg.hip, leg.knee, leg.ankle};
  std::vector<Vec3> line;
  for (double y = skeleton.crotch_y; y > kSole; y -= kLegStep) {
    const Vec3 guess = on_polyline_at_height(joints, y);
    Vec2 low = Vec2::Constant(1e9), high = -low;  // x, z
    for (const Vec2& p : slices.leg(y, side)) {
      if ((p - Vec2(guess.x(), guess.z())).norm() > kLegReach) continue;
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
    const Vec2 middle = low.x() <= high.x() ? Vec2(0.5 * (low + high)) : Vec2(guess.x(), guess.z());
    line.emplace_back(middle.x(), y, middle.y());
  }
  return line;
}

std::vector<Vec3> arm_line(const Skeleton::Arm& arm) {
  std::vector<Vec3> line = {arm.shoulder};
  const Vec3 direction = (arm.wrist - arm.shoulder).normalized();
  for (Eigen::Index i = arm.centre_line.rows(); i-- > 0;) {
    const Vec3 p = arm.centre_line.row(i);
    if ((p - line.back()).dot(direction) > 1e-3) line.push_back(p);
  }
  return line;
}

}  // namespace

Vec3 BodyGuides::leg_at(Side side, double y) const {
  const auto& line = leg[side];
  return line.size() < 2 ? Vec3(0, y, 0) : on_polyline_at_height(line, y);
}

Vec3 BodyGuides::arm_at(Side side, double along) const {
  const auto& line = arm[side];
  const Vec3& d = arm_direction[side];
  std::size_t k = 1;
  while (k + 1 < line.size() && (line[k] - line[0]).dot(d) < along) ++k;
  const double sa = (line[k - 1] - line[0]).dot(d), sb = (line[k] - line[0]).dot(d);
  const double t = sb > sa ? std::clamp((along - sa) / (sb - sa), 0.0, 1.0) : 0.0;
  return line[k - 1] + t * (line[k] - line[k - 1]);
}

BodyGuides find_body_guides(const Body& body, const SurfaceTree& surface) {
  const Skeleton& skeleton = *body.skeleton;
  const BodySlices slices(body.surface, false);
  BodyGuides guides;
  guides.levels.armpit_y = skeleton.armpit_y;
  guides.levels.waist_y = skeleton.waist_y;
  guides.levels.crotch_y = skeleton.crotch_y;
  for (const Side side : {Left, Right}) {
    const Skeleton::Arm& arm = skeleton.arms[side];
    guides.levels.shoulder_y += 0.5 * top_above(surface, arm.shoulder);
    guides.shoulder_z += 0.5 * arm.shoulder.z();
    guides.arm_direction[side] =
        Vec3(arm.wrist.x() - arm.shoulder.x(), arm.wrist.y() - arm.shoulder.y(), 0).normalized();
    guides.arm[side] = arm_line(arm);
    guides.leg[side] = leg_line(slices, skeleton, side);
  }
  return guides;
}

namespace {

// The vertices of both arms, from the finger tips to a plane a little outside the shoulder.
std::vector<bool> arm_vertices(const Body& body) {
  const Points3& x = body.surface.vertices;
  const Triangles& triangles = body.surface.triangles;
  std::vector<bool> cut(static_cast<std::size_t>(x.rows()), false);
  std::vector<std::vector<int>> neighbours(cut.size());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      neighbours[static_cast<std::size_t>(triangles(f, k))].push_back(triangles(f, (k + 1) % 3));
  for (const Side side : {Left, Right}) {
    const Skeleton::Arm& arm = body.skeleton->arms[side];
    const Vec3 direction = (arm.elbow - arm.shoulder).normalized();
    const Vec3 plane = arm.shoulder + kArmCut * direction;
    Eigen::Index tip = 0;
    (x.rowwise() - arm.hand_end.transpose()).rowwise().squaredNorm().minCoeff(&tip);
    std::vector<int> stack = {static_cast<int>(tip)};
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      const Vec3 p = x.row(v);
      if (cut[static_cast<std::size_t>(v)] || (p - plane).dot(direction) < 0) continue;
      cut[static_cast<std::size_t>(v)] = true;
      const auto& next = neighbours[static_cast<std::size_t>(v)];
      stack.insert(stack.end(), next.begin(), next.end());
    }
  }
  return cut;
}

// The rings round what was taken away, each in the direction of the removed triangles.
std::vector<std::vector<int>> rings_of(const std::set<std::pair<int, int>>& removed_edges) {
  std::map<int, int> next_on_ring;
  for (const auto& [from, to] : removed_edges)
    if (!removed_edges.contains({to, from})) next_on_ring[from] = to;
  std::vector<std::vector<int>> rings;
  while (!next_on_ring.empty()) {
    std::vector<int>& ring = rings.emplace_back();
    for (auto it = next_on_ring.begin(); it != next_on_ring.end(); it = next_on_ring.find(ring.back())) {
      ring.push_back(it->second);
      next_on_ring.erase(it);
    }
  }
  return rings;
}

// Without the triangles that have a vertex in `cut`; a fan from its middle closes each ring left open.
TriangleMesh capped_without(const TriangleMesh& surface, const std::vector<bool>& cut) {
  std::vector<Eigen::Vector3i> kept;
  std::set<std::pair<int, int>> removed_edges;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const Eigen::Vector3i t = surface.triangles.row(f);
    const bool gone = cut[static_cast<std::size_t>(t[0])] || cut[static_cast<std::size_t>(t[1])] ||
                      cut[static_cast<std::size_t>(t[2])];
    if (!gone) kept.emplace_back(t);
    for (int k = 0; gone && k < 3; ++k) removed_edges.emplace(t[k], t[(k + 1) % 3]);
  }
  const std::vector<std::vector<int>> rings = rings_of(removed_edges);
  const Eigen::Index first = surface.vertices.rows();
  TriangleMesh result;
  result.vertices.resize(first + static_cast<Eigen::Index>(rings.size()), 3);
  result.vertices.topRows(first) = surface.vertices;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<int>& ring = rings[r];
    const Eigen::Index centre = first + static_cast<Eigen::Index>(r);
    Vec3 middle = Vec3::Zero();
    for (int v : ring) middle += surface.vertices.row(v).transpose() / static_cast<double>(ring.size());
    result.vertices.row(centre) = middle.transpose();
    for (std::size_t i = 0; i < ring.size(); ++i)
      kept.emplace_back(ring[i], ring[(i + 1) % ring.size()], static_cast<int>(centre));
  }
  result.triangles.resize(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t f = 0; f < kept.size(); ++f)
    result.triangles.row(static_cast<Eigen::Index>(f)) = kept[f].transpose();
  return result;
}

}  // namespace

TriangleMesh body_without_arms(const Body& body) {
  return capped_without(body.surface, arm_vertices(body));
}

}  // namespace toile
