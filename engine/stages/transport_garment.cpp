// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/transport_garment.h"

#include <Eigen/Geometry>

#include "engine/core/units.h"
#include "engine/geometry/closest_point.h"

namespace toile {
namespace {

// Area-weighted vertex normals, unit length.
Points3 vertex_normals(const Points3& vertices, const Triangles& triangles) {
  Points3 normals = Points3::Zero(vertices.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Vec3 a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)), c = vertices.row(triangles(f, 2));
    const Vec3 twice_area = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) normals.row(triangles(f, k)) += twice_area.transpose();
  }
  normals.rowwise().normalize();
  return normals;
}

Vec3 interpolate(const Points3& values, const Eigen::Vector3i& corners, const Vec3& weights) {
  return weights[0] * values.row(corners[0]).transpose() + weights[1] * values.row(corners[1]).transpose() +
         weights[2] * values.row(corners[2]).transpose();
}

// Moves nodes that are nearer than `clearance` to the outside of the surface, and counts them.
struct PushOut {
  int pushed = 0;
  double deepest = 0.0;

  void apply(const SurfaceTree& tree, const TriangleMesh& surface, double clearance, Points3& nodes) {
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      const Vec3 p = nodes.row(i);
      const SurfacePoint nearest = tree.closest_point(p);
      const bool inside = tree.winding_number(p) > 0;
      if (!inside && nearest.distance() >= clearance) continue;
      const Eigen::Vector3i corners = surface.triangles.row(nearest.triangle);
      const Vec3 a = surface.vertices.row(corners[0]), b = surface.vertices.row(corners[1]),
                 c = surface.vertices.row(corners[2]);
      const Vec3 normal = (b - a).cross(c - a).normalized();
      nodes.row(i) = (nearest.point + clearance * normal).transpose();
      ++pushed;
      if (inside) deepest = std::max(deepest, nearest.distance());
    }
  }
};

}  // namespace

TransportGarmentResult transport_garment(const Drape& reference_drape, const Body& reference_body,
                                         const Body& target_body, const BodyMap& map,
                                         const TransportGarmentOptions& options, const Progress* progress) {
  const TriangleMesh& surface = reference_body.surface;
  const SurfaceTree reference_tree(surface.vertices, surface.triangles);
  const Points3 normals = vertex_normals(surface.vertices, surface.triangles);
  const Points3 mapped_normals = vertex_normals(map.mapped, surface.triangles);

  TransportGarmentResult result;
  Points3& nodes = result.drape.nodes;
  nodes.resize(reference_drape.nodes.rows(), 3);
  int near = -1;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const Vec3 v = reference_drape.nodes.row(i);
    const SurfacePoint c = reference_tree.closest_point(v, std::numeric_limits<double>::infinity(), near);
    near = c.triangle;
    const Eigen::Vector3i corners = surface.triangles.row(c.triangle);
    const Vec3 from = interpolate(normals, corners, c.barycentric);
    const Vec3 to = interpolate(mapped_normals, corners, c.barycentric);
    const auto turn = Eigen::Quaterniond::FromTwoVectors(from, to);
    nodes.row(i) = (interpolate(map.mapped, corners, c.barycentric) + turn * (v - c.point)).transpose();
  }
  report(progress, "transport", 0.5);

  PushOut push;
  push.apply(SurfaceTree(target_body.surface.vertices, target_body.surface.triangles), target_body.surface,
             options.clearance, nodes);
  result.diagnostics.add("nodes", static_cast<int>(nodes.rows()))
      .add("nodes_pushed_out", push.pushed)
      .add("deepest_before_push_mm", push.deepest * kMmPerMetre);
  report(progress, "transport", 1.0);
  return result;
}

}  // namespace toile
