// SPDX-License-Identifier: GPL-3.0-or-later
// What registration needs of a reference body and can be reused for any number of targets.
#pragma once

#include "engine/bodies/coarse_fit.h"

namespace toile {

// Points bound to a surface by barycentric weights, one row each.
struct SurfaceBinding {
  Triangles corners;  // #P x 3, vertices of the surface
  Points3 weights;    // #P x 3

  Points3 carry(const Points3& values) const;  // #surface vertices x 3 -> #P x 3
};

struct RegistrationReference {
  TriangleMesh surface;
  Landmarks landmarks;  // of the body
  BodyProportions proportions;
  Eigen::MatrixXd weights;       // #V x 16, bone_weights
  Eigen::VectorXd visible;       // #V, 1 or 0: whether the skin can be seen from outside (a mouth's inside cannot)
  TriangleMesh proxy;            // about 1500 vertices
  SurfaceBinding proxy_on_body;  // proxy vertices on the surface
  SurfaceBinding body_on_proxy;  // surface vertices on the proxy
  std::vector<std::string> warnings;
};

// Throws BodyNotRecognised where the reference is no upright person.
RegistrationReference prepare_reference(const Body& reference);

}  // namespace toile
