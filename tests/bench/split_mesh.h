// SPDX-License-Identifier: GPL-3.0-or-later
// Every triangle of a garment's mesh cut into four at the middles of its edges, sewn as before: the same cloth with
// half the edge length, so that what differs between drapes of both is the error of the coarser mesh.
#pragma once

#include "engine/core/pattern_mesh.h"

namespace toile::bench {

struct SplitMesh {
  PatternMesh mesh;
  // Per node of `mesh` the two nodes of the coarse mesh it lies half-way between; equal ones for nodes kept.
  std::vector<std::pair<int, int>> between;
};
SplitMesh split_mesh(const PatternMesh& coarse);

// Values at the coarse nodes (one row each) at the split mesh's nodes.
template <class Values>
Values at_split_nodes(const SplitMesh& split, const Values& coarse) {
  Values fine(split.mesh.node_count, coarse.cols());
  for (int i = 0; i < split.mesh.node_count; ++i) {
    const auto& [a, b] = split.between[static_cast<std::size_t>(i)];
    fine.row(i) = 0.5 * (coarse.row(a) + coarse.row(b));
  }
  return fine;
}

}  // namespace toile::bench
