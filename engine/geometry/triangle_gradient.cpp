// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/triangle_gradient.h"

namespace toile {

double doubled_area(const Points2& points, const Triangles& triangles, int f) {
  const Vec2 a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)), c = points.row(triangles(f, 2));
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

TriangleGradients triangle_gradients(const Points2& flat, const Triangles& triangles) {
  TriangleGradients result;
  result.triangles = triangles;
  result.inverse_edges.resize(static_cast<std::size_t>(triangles.rows()), Mat2::Zero());
  result.area = Eigen::VectorXd::Zero(triangles.rows());
  for (int f = 0; f < triangles.rows(); ++f) {
    Mat2 edges;
    edges.col(0) = flat.row(triangles(f, 1)) - flat.row(triangles(f, 0));
    edges.col(1) = flat.row(triangles(f, 2)) - flat.row(triangles(f, 0));
    const double doubled = edges.determinant();
    if (doubled == 0.0) continue;
    result.area[f] = 0.5 * std::abs(doubled);
    result.inverse_edges[static_cast<std::size_t>(f)] = edges.inverse();
  }
  return result;
}

}  // namespace toile
