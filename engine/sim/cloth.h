// SPDX-License-Identifier: GPL-3.0-or-later
// What the energies need to know of a garment's cloth: everything that depends on the rest shape alone. SI units.
// Triangles lie in blocks of kLanes, so that the energies work on four at a time.
#pragma once

#include "engine/core/fabric.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/numerics/sparse_solver.h"

namespace toile {

inline constexpr int kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

struct TriangleBlock {
  std::array<std::array<std::int32_t, kLanes>, 3> node;  // corner, lane
  Lanes u1, u2, v1, v2;  // Fu = u1 (xb - xa) + u2 (xc - xa), Fv likewise: columns of Dm^-1 in the grain's frame
  Lanes area;            // rest area, m^2; 0 in the lanes that fill up the last block
};

struct Cloth {
  Fabric fabric;
  int node_count = 0;
  int triangle_count = 0;
  std::vector<TriangleBlock> blocks;
  Eigen::VectorXd node_area;  // #N, a third of the triangles at the node, m^2
  SparseMatrix bending;       // #N x #N, symmetric, positive semidefinite: energy x^T Q x / 2 per coordinate, N/m
  double mean_edge = 0.0;     // h, mean rest edge length, m

  // Of one half of a symmetric garment (half_cloth.h), cut along x = 0; else there is no middle.
  bool half = false;
  std::vector<int> middle;      // nodes on the cut: their x is 0, their areas and bending are those of one side
  SparseMatrix bending_across;  // #N x #N, added to `bending` for x alone

  int whole_node_count() const;           // of both halves
  double mean_node_weight() const;        // N; what residuals are measured by, whatever gravity is
  void hold_middle(Points3& rows) const;  // x = 0 there
};

// The cloth of a pattern. Triangles whose nodes coincide are left out; hinges across `right_wrong` seams do not bend.
// The grain of a panel (its grainline, else +y) is the warp.
// Throws Error{GarmentInvalid} if a triangle is degenerate or reversed at rest.
Cloth make_cloth(const Pattern& pattern, const PatternMesh& mesh);

}  // namespace toile
