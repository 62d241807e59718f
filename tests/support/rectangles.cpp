// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/rectangles.h"

#include <numeric>

namespace toile::test {

Panel rectangle(const std::string& name, double width, double height) {
  Panel panel;
  panel.name = name;
  panel.corners = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  panel.edges.resize(4);
  return panel;
}

void weld_seams(PatternMesh& mesh) {
  std::vector<int> parent(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[static_cast<std::size_t>(v)] != v) v = parent[static_cast<std::size_t>(v)];
    return v;
  };
  for (const auto& seam : mesh.seam_vertices)
    for (const auto& [a, b] : seam) {
      const int ra = root(a), rb = root(b);
      parent[static_cast<std::size_t>(std::max(ra, rb))] = std::min(ra, rb);
    }
  mesh.node_of_vertex.assign(parent.size(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    int& node = mesh.node_of_vertex[static_cast<std::size_t>(root(v))];
    if (node < 0) node = mesh.node_count++;
    mesh.node_of_vertex[static_cast<std::size_t>(v)] = node;
  }
}

}  // namespace toile::test
