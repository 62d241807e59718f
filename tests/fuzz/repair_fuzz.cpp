// SPDX-License-Identifier: GPL-3.0-or-later
// Any triangles on a few lattice points: whatever is left after repair is a closed, oriented two-manifold.
#include "engine/geometry/clean_mesh.h"
#include "engine/geometry/close_holes.h"
#include "engine/geometry/half_edges.h"
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toile;
  constexpr int kPoints = 64;  // a 4 x 4 x 4 lattice; every byte names one corner
  const int count = static_cast<int>(std::min<std::size_t>(size / 3, 300));
  if (count == 0) return 0;
  TriangleMesh mesh;
  mesh.vertices.resize(kPoints, 3);
  for (int v = 0; v < kPoints; ++v) mesh.vertices.row(v) << v % 4, v / 4 % 4, v / 16;
  mesh.triangles.resize(count, 3);
  for (int f = 0; f < count; ++f)
    for (int k = 0; k < 3; ++k) mesh.triangles(f, k) = data[3 * f + k] % kPoints;
  clean_mesh(mesh);
  close_holes(mesh);
  if (mesh.triangle_count() == 0) return 0;
  fuzz::require(mesh.vertices.allFinite());
  fuzz::require(find_defects(mesh.vertex_count(), mesh.triangles).none());
  return 0;
}
