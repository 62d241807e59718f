// SPDX-License-Identifier: GPL-3.0-or-later
// Keep sides smooth while a pattern is derived: a side may move by what its own shape, stretched, sheared and turned,
// and low polynomials of its arc length can express; what is left of its vertices' positions costs energy.
//
// Quadratic and free of any local step: energy = sum over sides |X - Q Q^T X|^2, Q orthonormal.  Metres.
#pragma once

#include "engine/core/pattern_mesh.h"

namespace toile {

struct SmoothSide {
  std::vector<int> vertices;  // in order along the side
  Eigen::MatrixXd penalty;    // I - Q Q^T, symmetric, positive semidefinite

  double energy(const Points2& rest) const;  // m^2
};

// One per side with vertices enough to be rough; edges that meet in less than 5 degrees are one side.
std::vector<SmoothSide> smooth_sides(const PatternMesh& mesh);

}  // namespace toile
