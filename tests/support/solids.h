// SPDX-License-Identifier: GPL-3.0-or-later
// Closed test solids of known size, outward oriented.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/core/body.h"
#include "engine/geometry/half_edges.h"

namespace toile::test {

// Axis-parallel box between two corners: 8 vertices, 12 triangles.
inline TriangleMesh make_box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  mesh.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    mesh.vertices.row(i) << (i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2];
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5,
      3, 7, 5;
  return mesh;
}

// Sphere of `rings` latitudes between two poles and `segments` meridians; poles on the y axis.
inline TriangleMesh make_sphere(double radius, int rings, int segments, const Vec3& centre = Vec3::Zero()) {
  TriangleMesh mesh;
  mesh.vertices.resize(rings * segments + 2, 3);
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const double theta = std::numbers::pi * (r + 1) / (rings + 1), phi = 2 * std::numbers::pi * s / segments;
      const Vec3 direction(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      mesh.vertices.row(r * segments + s) = (centre + radius * direction).transpose();
    }
  const int north = rings * segments, south = north + 1;
  mesh.vertices.row(north) = (centre + Vec3(0, radius, 0)).transpose();
  mesh.vertices.row(south) = (centre - Vec3(0, radius, 0)).transpose();
  mesh.triangles.resize(2 * rings * segments, 3);
  int f = 0;
  for (int s = 0; s < segments; ++s) {
    const int t = (s + 1) % segments;
    mesh.triangles.row(f++) << north, s, t;
    for (int r = 0; r + 1 < rings; ++r) {
      const int a = r * segments + s, b = r * segments + t;
      mesh.triangles.row(f++) << a, a + segments, b;
      mesh.triangles.row(f++) << b, a + segments, b + segments;
    }
    mesh.triangles.row(f++) << south, (rings - 1) * segments + t, (rings - 1) * segments + s;
  }
  return mesh;
}

inline bool is_closed(const TriangleMesh& mesh) {
  return find_defects(mesh.vertex_count(), mesh.triangles).none();
}

inline double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.triangles(f, 0)), b = mesh.vertices.row(mesh.triangles(f, 1)),
               c = mesh.vertices.row(mesh.triangles(f, 2));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

}  // namespace toile::test
