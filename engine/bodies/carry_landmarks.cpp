// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/carry_landmarks.h"

#include "engine/geometry/closest_point.h"

namespace toile {

Landmarks carry_landmarks(const Landmarks& points, const TriangleMesh& reference, const Points3& mapped) {
  const SurfaceTree tree(reference.vertices, reference.triangles);
  Landmarks carried;
  for (const auto& [name, point] : points) {
    const SurfacePoint c = tree.closest_point(point);
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < 3; ++k) place += c.barycentric[k] * mapped.row(reference.triangles(c.triangle, k)).transpose();
    carried[name] = place;
  }
  return carried;
}

}  // namespace toile
