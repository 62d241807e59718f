// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of cloth with a body, and friction on it. Per node of area A at distance phi from the body:
//   contact  E = kc A f(t - phi),  f(d) = d^2 / 2 for 0 < d <= d1, linear beyond d1, 0 for d <= 0
//   friction E = mu N s(|u|), u the tangential move away from the node's anchor, N the contact force and the tangent
//            plane of the last freeze, s(u) = u^2/e - u^3/(3 e^2) below the slip length e and u - e/3 above. A freeze
//            drags the anchors of nodes that have slipped along and leaves those that stick: cloth does not creep.
// The stiffness is per area: contact depth does not depend on the mesh. Source: design/sewing.md F; the friction
// profile is that of [Li2020] (incremental potential contact).
#pragma once

#include "engine/geometry/distance_field.h"
#include "engine/sim/cloth.h"
#include "engine/sim/energy_hessian.h"
#include "engine/sim/friction_state.h"

namespace toile {

struct ContactOptions {
  double thickness = 0.003;     // distance kept between the nodes and the body, m, >= 0
  double stiffness = 2e6;       // kc, N/m^3: 1 kPa of pressure sinks in 0.5 mm
  double linear_beyond = 0.01;  // d1, m: deeper nodes are pushed with constant force
  double friction = 0.3;        // mu, dimensionless, >= 0; 0: none
  double slip_length = 0.001;   // e, m, > 0: below it friction is a spring
  bool multipliers =
      false;  // every freeze takes up the present force as a constant one: rounds of it press out all depth
};

// f and f' above.
double contact_profile(double depth, double linear_beyond, double& slope);
// s and s'(u) / u above (finite at u = 0).
double friction_profile(double length, double slip_length, double& slope_over_length);

class Contact {
 public:
  // Both must outlive the contact.
  Contact(const Cloth& cloth, SignedField& field, const ContactOptions& options);

  // Adds the gradient (#N x 3, N) and returns the energy, J.
  double energy_gradient(const Points3& nodes, Points3& gradient);

  // Adds the second derivatives at `nodes`, of contact and of friction as it is frozen.
  void add_hessian(const Points3& nodes, Curvature curvature, BlockHessian& hessian);

  // Takes up the contact forces at `nodes` and drags anchors that are further away than the slip length; nodes newly in
  // contact are anchored where they are.
  // The energy changes: evaluate again.
  void freeze_friction(const Points3& nodes);
  // The same at a start where contact has not been felt yet: a node within `reach` of the contact thickness presses as
  // hard as `pull`, the gradient of all other energies (#N x 3, N), draws it to the body. Without it a garment starts
  // to slide before its contact forces have built up.
  void freeze_friction(const Points3& nodes, const Points3& pull, double reach);

  // Friction as the last freeze left it.
  FrictionState friction() const { return {load_, anchor_, normal_}; }
  // Friction as given to begin with, or `for_good`: freezes change nothing any more.
  void start_friction(const FrictionState& state, bool for_good);
  bool frozen() const { return frozen_; }

  // Diagonal of an upper bound of the contact's Hessian at the nodes of the last evaluation, N/m.
  void stiffness_diagonal(Eigen::VectorXd& diagonal) const;

  const ContactOptions& options() const { return options_; }
  // Distance of a node at the last evaluation: exact within the contact thickness, else a lower bound.
  const Eigen::VectorXd& distances() const { return distance_; }

 private:
  // Distance and gradient at a node, skipped while the node cannot have come into contact since it was last looked up.
  bool near(Eigen::Index i, const Vec3& p, Vec3& normal);
  // Anchor within the slip length of p, in its tangent plane.
  Vec3 dragged_anchor(Eigen::Index i, const Vec3& p, const Vec3& normal) const;
  // Depth that counts for the force.
  double depth(Eigen::Index i) const { return options_.thickness - distance_[i] + taken_up_[i]; }

  const Cloth& cloth_;
  SignedField& field_;
  ContactOptions options_;
  Eigen::VectorXd distance_;        // #N
  Points3 looked_up_at_;            // #N x 3, where distance_ was taken
  std::vector<bool> known_;         // #N
  std::vector<std::int32_t> hint_;  // #N, of the field

  Eigen::VectorXd taken_up_;            // #N, depth whose force is applied without any depth; only with multipliers, m
  bool frozen_ = false, held_ = false;  // held: for good
  Eigen::VectorXd load_;                // #N, mu N of the last freeze, N
  Points3 anchor_, normal_;             // #N x 3
};

}  // namespace toile
