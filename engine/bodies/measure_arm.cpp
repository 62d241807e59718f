// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/measure_arm.h"

#include <Eigen/Geometry>

#include "engine/geometry/mesh_slicer.h"

namespace toile {
namespace {

constexpr double kStep = 0.02;                         // of the bone's length
constexpr double kUpperLow = 0.24, kUpperHigh = 0.40;  // of the way from elbow to shoulder
constexpr double kGrown = 1.08;  // from one slice to the next: the plane meets the trunk, as on stout bodies
constexpr double kWristLow = -0.10, kWristHigh = 0.25;  // of the way from wrist to elbow
// Fractions of the height: where the least girth is sought about the skeleton's wrist, steps, and how far the wrist is
// from where the forearm has grown (mean of the 15 bodies of shared/data).
constexpr double kLeastLow = -0.03, kLeastHigh = 0.05, kForearmStep = 0.004, kWristBelow = 0.0565;
constexpr double kThickest = 0.30, kForearmEnd = 0.85;  // of the way from wrist to elbow
constexpr double kGrowth[] = {0.5, 0.6, 0.7};           // from least to largest girth

// The body turned so that the bone from `from` to `to` stands upright on the origin.
class BoneFrame {
 public:
  BoneFrame(const TriangleMesh& body, const Vec3& from, const Vec3& to)
      : length_((to - from).norm()), turned_(upright(body, from, to)), slicer_(turned_) {}

  // Hull girth of the piece round the bone at a fraction of its length; 0 where there is none.
  double girth(double fraction) const {
    for (const SliceComponent& c : slicer_.slice(fraction * length_))
      if ((c.low.array() < 0).all() && (c.high.array() > 0).all()) return c.hull_girth();
    return 0.0;
  }

 private:
  static TriangleMesh upright(const TriangleMesh& body, const Vec3& from, const Vec3& to) {
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(to - from, Vec3::UnitY()).toRotationMatrix();
    return {(body.vertices.rowwise() - from.transpose()) * turn.transpose(), body.triangles};
  }

  double length_;
  TriangleMesh turned_;
  MeshSlicer slicer_;
};

// How far up the forearm its girth first reaches a value, from a place where it is less; none if it does not.
std::optional<double> reached(const std::vector<Vec2>& girths, std::size_t from, double girth) {
  for (std::size_t i = from; i + 1 < girths.size(); ++i) {
    const Vec2 &a = girths[i], &b = girths[i + 1];
    if (b.y() >= girth) return a.x() + (b.x() - a.x()) * (girth - a.y()) / (b.y() - a.y());
  }
  return std::nullopt;
}

}  // namespace

Vec3 find_wrist(const TriangleMesh& body, const Skeleton::Arm& arm, double height) {
  const BoneFrame fore(body, arm.wrist, arm.elbow);
  const double length = (arm.elbow - arm.wrist).norm();
  std::vector<Vec2> girths;  // way from the skeleton's wrist, girth
  for (double s = kLeastLow * height; s < kForearmEnd * length; s += kForearmStep * height)
    if (const double girth = fore.girth(s / length); girth > 0) girths.emplace_back(s, girth);
  std::size_t least = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < girths.size(); ++i) {
    if (girths[i].x() < kLeastHigh * height && girths[i].y() < girths[least].y()) least = i;
    if (girths[i].x() > kThickest * length) most = std::max(most, girths[i].y());
  }
  double way = -kWristBelow * height;
  for (const double growth : kGrowth) {
    if (girths.empty()) return arm.wrist;
    const auto there = reached(girths, least, girths[least].y() + growth * (most - girths[least].y()));
    if (!there) return arm.wrist;
    way += *there / static_cast<double>(std::size(kGrowth));
  }
  return arm.wrist + (arm.elbow - arm.wrist) * (way / length);
}

ArmGirths measure_arm(const TriangleMesh& body, const Skeleton::Arm& arm) {
  ArmGirths girths;
  const BoneFrame upper(body, arm.elbow, arm.shoulder), fore(body, arm.wrist, arm.elbow);
  for (double t = kUpperLow; t <= kUpperHigh + 1e-9; t += kStep) {
    const double g = upper.girth(t);
    if (girths.upper_arm > 0 && g > kGrown * girths.upper_arm) break;
    if (g > 0) girths.upper_arm = g;
  }
  for (double t = kWristLow; t <= kWristHigh; t += kStep) {
    const double g = fore.girth(t);
    if (g > 0 && (girths.wrist == 0 || g < girths.wrist)) girths.wrist = g;
  }
  return girths;
}

}  // namespace toile
