// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes beside a square of cloth either become its mesh and drape, or a named refusal.
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/io/worn_garment.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  toile::Pattern pattern;
  toile::Panel square;
  square.name = "square";
  square.corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  square.edges.resize(4);
  pattern.panels = {square};
  try {
    const toile::WornGarment worn = toile::read_worn_garment({data, size}, "fuzz", pattern);
    const toile::PatternMesh& mesh = worn.mesh;
    if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertex_count()) std::abort();
    if (worn.drape.nodes.rows() != mesh.node_count || !worn.drape.nodes.allFinite()) std::abort();
    if (!worn.wanted.empty() && static_cast<int>(worn.wanted.size()) != mesh.triangle_count()) std::abort();
    if (mesh.edge_vertices.size() != 1 || mesh.edge_vertices[0].size() != 4) std::abort();
  } catch (const toile::Error& error) {
    if (error.subject.empty() || error.message.empty() || toile::exit_code(error.code) != 3) std::abort();
  }
  return 0;
}
