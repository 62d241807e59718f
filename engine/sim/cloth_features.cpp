// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth_features.h"

#include <algorithm>

namespace toile {

ClothFeatures::ClothFeatures(const PatternMesh& mesh) {
  std::vector<Eigen::Vector3i> kept;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    const Eigen::Vector3i n = mesh.nodes_of_triangle(f);
    if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) continue;
    kept.push_back(n);
    rest.emplace_back();
    for (int k = 0; k < 3; ++k) rest.back().row(k) << mesh.rest.row(mesh.triangles(f, k)), 0;
    panel.push_back(mesh.panel_of_triangle[static_cast<std::size_t>(f)]);
  }
  triangles.resize(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t f = 0; f < kept.size(); ++f) triangles.row(static_cast<Eigen::Index>(f)) = kept[f].transpose();
  find_owners(mesh.node_count);
}

void ClothFeatures::find_owners(int node_count) {
  struct Side {
    std::pair<int, int> nodes;
    int triangle, corner;
  };
  std::vector<Side> sides;
  owner_of_node.assign(static_cast<std::size_t>(node_count), -1);
  for (int f = 0; f < triangle_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      sides.push_back({std::minmax(triangles(f, k), triangles(f, (k + 1) % 3)), f, k});
      int& owner = owner_of_node[static_cast<std::size_t>(triangles(f, k))];
      if (owner < 0) owner = f;
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
  });
  owned_edges.assign(static_cast<std::size_t>(triangle_count()), {-1, -1, -1});
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i == 0 || sides[i - 1].nodes != side.nodes) {
      owned_edges[static_cast<std::size_t>(side.triangle)][static_cast<std::size_t>(side.corner)] =
          static_cast<int>(edges.size());
      edges.push_back({{side.nodes.first, side.nodes.second}, {side.triangle, -1}});
    } else if (edges.back().triangle[1] < 0) {
      edges.back().triangle[1] = side.triangle;
    }
  }
}

Points2 ClothFeatures::centres() const {
  Points2 centres(triangles.rows(), 2);
  for (std::size_t f = 0; f < rest.size(); ++f)
    centres.row(static_cast<Eigen::Index>(f)) = rest[f].colwise().mean().head<2>();
  return centres;
}

}  // namespace toile
