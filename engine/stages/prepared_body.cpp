// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/prepared_body.h"

#include "engine/bodies/find_skeleton.h"

namespace toile {

PreparedBody::PreparedBody(const Body& given) : body_(given) {
  if (body_.kind == BodyKind::Human && !body_.skeleton) body_.skeleton = find_skeleton(body_.surface).skeleton;
}

const BodyGuides& PreparedBody::guides() {
  if (!guides_) guides_ = find_body_guides(body_, SurfaceTree(body_.surface.vertices, body_.surface.triangles));
  return *guides_;
}

SurfaceField& PreparedBody::field(bool armless) {
  std::unique_ptr<SurfaceField>& field = fields_[armless];
  if (!field) {
    const TriangleMesh surface = armless ? body_without_arms(body_) : body_.surface;
    field = std::make_unique<SurfaceField>(surface.vertices, surface.triangles);
  }
  return *field;
}

}  // namespace toile
