// SPDX-License-Identifier: GPL-3.0-or-later
// Bend the coarse fit of a reference body onto the surface of a target body.
//
// Unknown: displacement d of every vertex from the coarse fit. From coarse to fine levels, repeat
//   R = w (tau r + (1 - tau) n' n'^T r),  r = p - x      p: closest point that faces the same way, w: robust weight
//   minimise  sum_i A_i |d_i - (d_i + R_i)|^2 + ell^4 |L d|^2_{A^-1}      (thin plate; one factorisation a level)
// Source: shared design page "registration", section 1.5. Metres.
#pragma once

#include "engine/bodies/registration_reference.h"
#include "engine/core/progress.h"
#include "engine/geometry/closest_point.h"

namespace toile {

// The surface that is fitted to: the skin that was seen (patches over holes are not), lightly smoothed, with normals
// and open edges.
class FitTarget {
 public:
  explicit FitTarget(const TriangleMesh& seen);

  const TriangleMesh& surface() const { return surface_; }
  const SurfaceTree& tree() const { return tree_; }
  Vec3 normal(const SurfacePoint& p) const;  // smooth, not of unit length
  bool on_open_edge(const SurfacePoint& p) const;
  bool is_clean() const { return clean_; }  // a model, exact to its vertices (surface_roughness)

 private:
  bool clean_;
  TriangleMesh surface_;
  SurfaceTree tree_;
  Points3 normals_;
  std::vector<bool> open_vertex_, open_edge_;  // #V; #F * 3
};

// A point of the reference that must come to lie at a place of the target.
struct Pin {
  int vertex = 0;
  Vec3 place = Vec3::Zero();
  double share = 1.0;  // of the weight of a pin, 0..1
};

// `coarse`: #V x 3. `height` of the target. Returns #V x 3.
Points3 refine_map(const RegistrationReference& reference, const Points3& coarse, const FitTarget& target,
                   double height, const std::vector<Pin>& pins, const Progress* progress);

}  // namespace toile
