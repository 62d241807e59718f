// SPDX-License-Identifier: GPL-3.0-or-later
// Move inner vertices of a flat triangle mesh so that no triangle is inverted.
//
// Unknowns: the free vertices. Minimises  sum_f A_f (|G|^2 + det^2 G + 1) / chi(det G),  chi(d) = (d + sqrt(d^2 + e^2))
// / 2 over the gradients G from the undeformed mesh; e falls to zero as inverted triangles open, so that the energy
// becomes a barrier.  Source: [Garanzha2021], with L-BFGS.  Same unit in and out.
#pragma once

#include <vector>

#include "engine/geometry/triangle_gradient.h"

namespace toile {

struct UnfoldResult {
  int inverted_before = 0, inverted_after = 0;  // triangles with det G below `least`
  int moved_vertices = 0;                       // that were free at the end
};

// `undeformed` gives the gradients (triangle_gradients of a mesh without inverted triangles), `positions` (#V x 2) are
// changed; vertices with `held` stay. Only what surrounds inverted triangles is set free, more of it as long as that
// does not do. `least`: smallest determinant that is good enough, > 0.
UnfoldResult unfold_triangles(const TriangleGradients& undeformed, const std::vector<bool>& held, double least,
                              Points2& positions);

}  // namespace toile
