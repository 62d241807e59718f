// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a triangle surface as a graph, and shortest ways along them.
#pragma once

#include <span>

#include "engine/core/body.h"

namespace toile {

class EdgeGraph {
 public:
  explicit EdgeGraph(const TriangleMesh& mesh);

  const std::vector<std::array<int, 2>>& edges() const { return edges_; }  // each once, smaller vertex first, sorted
  std::span<const int> neighbours(int vertex) const;                       // ascending

  // Length of the shortest way along edges from the nearest source, m; infinity where none leads (Dijkstra).
  Eigen::VectorXd distances(std::span<const int> sources) const;

 private:
  std::vector<std::array<int, 2>> edges_;
  std::vector<int> begin_, neighbour_;
  std::vector<double> length_;  // parallel to neighbour_
};

}  // namespace toile
