// SPDX-License-Identifier: GPL-3.0-or-later
// Per triangle, the gradient a target pattern is wanted to have: J^-1 R M, with the rotation R on the drape's side as
// its one local unknown. Used by derive_pattern only.
#pragma once

#include <vector>

#include "engine/core/fitting_map.h"

namespace toile {

class WantedGradients {
 public:
  // `reference` holds the wanted tensors J, `target` the tensors M of the target drape over the reference pattern.
  WantedGradients(const FittingMap& reference, const FittingMap& target);

  // Turns R to the minimum of |J^-1 R M - gradient|^2 from where it stands; the distance never grows.
  void turn(int f, const Mat2& gradient);
  Mat2 wanted(int f) const;

 private:
  struct Face {
    Mat2 a, b;          // J^-1 M and J^-1 Rot90 M: wanted = a cos + b sin
    double aa, bb, ab;  // their inner products
    double cosine = 1.0, sine = 0.0;
  };
  static double energy(const Face& face, double c, double s, double p, double q);

  std::vector<Face> faces_;
};

}  // namespace toile
