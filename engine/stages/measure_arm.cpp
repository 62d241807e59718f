// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/measure_arm.h"

#include <Eigen/Geometry>

#include "engine/geometry/mesh_slicer.h"

namespace toile {
namespace {

constexpr double kStep = 0.02;                         // of the bone's length
constexpr double kUpperLow = 0.25, kUpperHigh = 0.70;  // of the way from elbow to shoulder
constexpr double kGrown = 1.25;  // from one slice to the next: the plane meets the trunk, as on stout bodies
constexpr double kWristLow = -0.10, kWristHigh = 0.25;  // of the way from wrist to elbow

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

}  // namespace

ArmGirths measure_arm(const TriangleMesh& body, const Skeleton::Arm& arm) {
  ArmGirths girths;
  const BoneFrame upper(body, arm.elbow, arm.shoulder), fore(body, arm.wrist, arm.elbow);
  for (double t = kUpperLow; t <= kUpperHigh; t += kStep) {
    const double g = upper.girth(t);
    if (girths.upper_arm > 0 && g > kGrown * girths.upper_arm) break;
    girths.upper_arm = std::max(girths.upper_arm, g);
  }
  for (double t = kWristLow; t <= kWristHigh; t += kStep) {
    const double g = fore.girth(t);
    if (g > 0 && (girths.wrist == 0 || g < girths.wrist)) girths.wrist = g;
  }
  return girths;
}

}  // namespace toile
