// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/register_bodies.h"

#include "engine/core/error.h"

namespace toile {

RegisterBodiesResult register_bodies(const Body& reference, const Body& target, const RegisterBodiesOptions& options,
                                     const Progress* progress) {
  RegisterBodiesResult result;
  const bool shared = reference.surface.triangles.rows() == target.surface.triangles.rows() &&
                      reference.surface.triangles == target.surface.triangles;
  if (!options.use_shared_topology || !shared)
    throw Error(ErrorCode::RegistrationFailed, "target_body",
                "the two bodies do not share one topology; give a target body with the vertices and triangles of the "
                "reference body in the same order");
  result.map.mapped = target.surface.vertices;
  result.map.exact = true;
  result.diagnostics.add("method", "shared_topology").add("vertices", reference.surface.vertex_count());
  report(progress, "register", 1.0);
  return result;
}

}  // namespace toile
