// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh reader promises for any bytes: a mesh that keeps the contract, or an Error with a subject and a message.
#pragma once

#include <cmath>
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/io/mesh_readers.h"

namespace toile::fuzz {

inline void require(bool condition) {
  if (!condition) std::abort();
}

using MeshReader = TriangleMesh (*)(std::span<const std::uint8_t>, const std::string&, const MeshLimits&);

inline int try_reader(MeshReader reader, const std::uint8_t* data, std::size_t size) {
  const MeshLimits limits{.bytes = 1 << 20, .vertices = 2000, .triangles = 4000};
  try {
    const TriangleMesh mesh = reader({data, size}, "fuzz", limits);
    require(mesh.triangle_count() > 0 && mesh.triangle_count() <= limits.triangles);
    require(mesh.vertex_count() <= limits.vertices);
    require(mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertex_count());
    require(mesh.vertices.array().abs().maxCoeff() <= limits.coordinate);
  } catch (const Error& error) {
    require(!error.subject.empty() && !error.message.empty() && exit_code(error.code) == 3);
  }
  return 0;
}

}  // namespace toile::fuzz
