// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/measure_neck.h"

#include <numbers>

#include <Eigen/Geometry>

#include "engine/geometry/mesh_slicer.h"

namespace toile {
namespace {

constexpr double kLean =
    20.0 * std::numbers::pi / 180.0;            // of necks, rad: the least girths of shared/data lie at 16-24
constexpr double kBelow = 0.03, kAbove = 0.02;  // of the height, from the skeleton's neck
constexpr double kStep = 0.001;                 // of the height

}  // namespace

NeckGirth measure_neck(const TriangleMesh& body, const Skeleton& skeleton) {
  const Mat3 lean = Eigen::AngleAxisd(-kLean, Vec3::UnitX()).toRotationMatrix();  // takes the tape's plane level
  const TriangleMesh turned{(body.vertices.rowwise() - skeleton.neck.transpose()) * lean.transpose(), body.triangles};
  const MeshSlicer slicer(turned);
  NeckGirth least;
  for (double s = -kBelow; s <= kAbove; s += kStep) {
    double girth = 0.0;
    for (const SliceComponent& piece : slicer.slice(s * skeleton.height))
      if (piece.low.x() < 0 && piece.high.x() > 0) girth = std::max(girth, piece.hull_girth());
    if (girth > 0 && (least.length == 0 || girth < least.length))
      least = {skeleton.neck.y() + s * skeleton.height * std::cos(kLean), girth};
  }
  return least;
}

}  // namespace toile
