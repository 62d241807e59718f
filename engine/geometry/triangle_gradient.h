// SPDX-License-Identifier: GPL-3.0-or-later
// Gradients of piecewise linear maps on a flat triangle mesh, and the quadratic form they make.
#pragma once

#include "engine/core/types.h"

namespace toile {

// What every gradient on a flat mesh needs, computed once. `inverse_edges[f]` is Dm^-1 with Dm = [X1-X0, X2-X0].
struct TriangleGradients {
  Triangles triangles;
  std::vector<Mat2> inverse_edges;  // #F
  Eigen::VectorXd area;             // #F, unsigned; zero for a degenerate triangle, whose inverse is zero too

  int triangle_count() const { return static_cast<int>(inverse_edges.size()); }

  // Gradient [d/du d/dv] of the map that carries the flat vertices to the rows of `image`: dim x 2.
  template <class Points>
  Eigen::Matrix<double, Points::ColsAtCompileTime, 2> of(const Points& image, int f) const {
    Eigen::Matrix<double, Points::ColsAtCompileTime, 2> edges;
    edges.col(0) = (image.row(triangles(f, 1)) - image.row(triangles(f, 0))).transpose();
    edges.col(1) = (image.row(triangles(f, 2)) - image.row(triangles(f, 0))).transpose();
    return edges * inverse_edges[static_cast<std::size_t>(f)];
  }

  // Row k: derivative of the gradient by the position of corner k; sums to zero over the corners.
  Eigen::Matrix<double, 3, 2> corner_weights(int f) const {
    const Mat2& inverse = inverse_edges[static_cast<std::size_t>(f)];
    Eigen::Matrix<double, 3, 2> weights;
    weights.row(1) = inverse.row(0);
    weights.row(2) = inverse.row(1);
    weights.row(0) = -(inverse.row(0) + inverse.row(1));
    return weights;
  }
};

TriangleGradients triangle_gradients(const Points2& flat, const Triangles& triangles);

// Twice the signed area of triangle `f` of `points` (> 0 counter-clockwise).
double doubled_area(const Points2& points, const Triangles& triangles, int f);

}  // namespace toile
