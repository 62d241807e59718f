// SPDX-License-Identifier: GPL-3.0-or-later
// Where a point of the plane lies in a flat triangle mesh, for carrying values from one layout of a mesh to another.
// Any lengths; immutable after construction.
#pragma once

#include "engine/geometry/closest_point.h"

namespace toile {

struct FlatPlace {
  int triangle = -1;
  Vec3 weights = Vec3::Zero();  // of the triangle's corners, sum 1

  // Value at the place of an array with one row per mesh vertex.
  template <class Rows>
  auto of(const Rows& rows, const Triangles& triangles) const {
    return (weights[0] * rows.row(triangles(triangle, 0)) + weights[1] * rows.row(triangles(triangle, 1)) +
            weights[2] * rows.row(triangles(triangle, 2)))
        .eval();
  }
};

class FlatLocator {
 public:
  // Requires at least one triangle; triangles may overlap or be turned over, none may be without area.
  FlatLocator(const Points2& points, const Triangles& triangles);

  FlatPlace closest(const Vec2& p) const;  // weights >= 0: of the nearest point of the mesh
  // The same triangle continued beyond its border: weights may be negative where `p` lies outside the mesh.
  FlatPlace extended(const Vec2& p) const;

 private:
  Points2 points_;
  Triangles triangles_;
  SurfaceTree tree_;
};

}  // namespace toile
