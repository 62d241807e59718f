// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes either become a garment whose mesh and seams agree, or a named refusal.
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/io/obj_garment.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const toile::ObjGarment garment = toile::read_obj_garment({data, size}, "fuzz");
    if (garment.pattern.panels.empty()) std::abort();
    if (garment.mesh) {
      const toile::PatternMesh& mesh = *garment.mesh;
      if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertex_count()) std::abort();
      if (!garment.drape || garment.drape->nodes.rows() != mesh.node_count) std::abort();
      if (mesh.seam_vertices.size() != garment.pattern.seams.size()) std::abort();
    }
  } catch (const toile::Error& error) {
    if (error.subject.empty() || error.message.empty() || toile::exit_code(error.code) != 3) std::abort();
  }
  return 0;
}
