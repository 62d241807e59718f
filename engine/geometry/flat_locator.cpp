// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/flat_locator.h"

#include <cassert>

namespace toile {
namespace {

Points3 lifted(const Points2& points) {
  Points3 space = Points3::Zero(points.rows(), 3);
  space.leftCols<2>() = points;
  return space;
}

}  // namespace

FlatLocator::FlatLocator(const Points2& points, const Triangles& triangles)
    : points_(points), triangles_(triangles), tree_(lifted(points), triangles) {
  assert(triangles.rows() > 0);
}

FlatPlace FlatLocator::closest(const Vec2& p) const {
  const SurfacePoint found = tree_.closest_point({p.x(), p.y(), 0.0});
  return {found.triangle, found.barycentric};
}

FlatPlace FlatLocator::extended(const Vec2& p) const {
  FlatPlace place = closest(p);
  const Vec2 origin = points_.row(triangles_(place.triangle, 0));
  Mat2 edges;
  for (int k = 0; k < 2; ++k) edges.col(k) = points_.row(triangles_(place.triangle, k + 1)).transpose() - origin;
  if (std::abs(edges.determinant()) < 1e-12 * edges.squaredNorm()) return place;  // a needle: its continuation is noise
  const Vec2 st = edges.inverse() * (p - origin);
  place.weights = {1.0 - st.sum(), st.x(), st.y()};
  return place;
}

}  // namespace toile
