// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dressed.h"

#include "engine/stages/find_skeleton.h"
#include "engine/stages/import_pattern.h"
#include "tests/support/shared_body.h"
#include "tests/support/shared_data.h"

namespace toile::test {
namespace {

Body body_with_skeleton(const std::string& name) {
  Body body = load_shared_body(name);
  body.skeleton = find_skeleton(body.surface).skeleton;
  return body;
}

BodyLevels levels_of(const Body& body) {
  return find_body_guides(body, SurfaceTree(body.surface.vertices, body.surface.triangles)).levels;
}

}  // namespace

Dressing dress(const std::string& garment, int triangles, const std::string& body) {
  const std::string own = body_of_garment(garment), worn_by = body.empty() ? own : body;
  Dressing dressing;
  dressing.pattern = import_pattern(read_file(shared_data("garments/" + garment + "_specification.json")));
  dressing.mesh = mesh_panels(dressing.pattern, {.triangles = triangles, .edge_length = {}});
  dressing.body = body_with_skeleton(worn_by);
  if (worn_by != own) dressing.options.drafted_for = levels_of(body_with_skeleton(own));
  return dressing;
}

}  // namespace toile::test
