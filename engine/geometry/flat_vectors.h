// SPDX-License-Identifier: GPL-3.0-or-later
// Small things about vectors and triangles of the plane. Any lengths.
#pragma once

#include "engine/core/types.h"

namespace toile {

// Twice the signed area of the triangle 0, a, b: positive where b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Over the edges of all triangles, inner ones counted from both sides; 0 without triangles.
inline double mean_edge_length(const Points2& points, const Triangles& triangles) {
  double sum = 0.0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) sum += (points.row(triangles(f, k)) - points.row(triangles(f, (k + 1) % 3))).norm();
  return triangles.rows() > 0 ? sum / (3.0 * static_cast<double>(triangles.rows())) : 0.0;
}

}  // namespace toile
