// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/registration_reference.h"

#include "engine/bodies/body_bones.h"
#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/visible_skin.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/decimate.h"
#include "engine/geometry/surface_operators.h"

namespace toile {
namespace {

constexpr int kProxyVertices = 1500;

// Binds points to the closest place of a surface; where normals are given, to one that faces the same way if there is
// any.
SurfaceBinding bind(const Points3& points, const Points3* normals, const TriangleMesh& surface) {
  const SurfaceTree tree(surface.vertices, surface.triangles);
  SurfaceBinding binding;
  binding.corners.resize(points.rows(), 3);
  binding.weights.resize(points.rows(), 3);
  int near = -1;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i);
    SurfacePoint c;
    if (normals) c = tree.closest_point_facing(p, normals->row(i), 0.0, std::numeric_limits<double>::infinity(), near);
    if (!c.found()) c = tree.closest_point(p, std::numeric_limits<double>::infinity(), near);
    near = c.triangle;
    binding.corners.row(i) = surface.triangles.row(c.triangle);
    binding.weights.row(i) = c.barycentric;
  }
  return binding;
}

}  // namespace

Points3 SurfaceBinding::carry(const Points3& values) const {
  Points3 out(corners.rows(), 3);
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    out.row(i) = weights(i, 0) * values.row(corners(i, 0)) + weights(i, 1) * values.row(corners(i, 1)) +
                 weights(i, 2) * values.row(corners(i, 2));
  return out;
}

RegistrationReference prepare_reference(const Body& reference) {
  RegistrationReference out;
  out.surface = reference.surface;
  out.landmarks = reference.landmarks;
  FindSkeletonResult found = find_skeleton(out.surface);
  out.warnings = std::move(found.warnings);
  out.proportions = find_proportions(out.surface, found.skeleton);
  out.weights = bone_weights(out.surface, found.skeleton);
  out.visible = visible_skin(out.surface);
  out.proxy = decimate(out.surface, kProxyVertices);
  const Points3 proxy_normals = vertex_normals(out.proxy.vertices, out.proxy.triangles);
  const Points3 normals = vertex_normals(out.surface.vertices, out.surface.triangles);
  out.proxy_on_body = bind(out.proxy.vertices, &proxy_normals, out.surface);
  out.body_on_proxy = bind(out.surface.vertices, &normals, out.proxy);
  return out;
}

}  // namespace toile
