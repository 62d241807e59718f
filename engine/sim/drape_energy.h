// SPDX-License-Identifier: GPL-3.0-or-later
// The energy whose least value is the drape: membrane + bending + gravity + contact + friction + cloth on cloth
// + holds + pins. J.
#pragma once

#include "engine/core/helper.h"
#include "engine/sim/cloth_contact.h"
#include "engine/sim/contact.h"
#include "engine/sim/edge_contact.h"
#include "engine/sim/half_cloth.h"

namespace toile {

// Keeps a node from sinking below a height: E = k min(0, y - height)^2 / 2. Skirts and trousers hang from these.
struct Hold {
  int node = 0;
  double height = 0.0;     // m
  double stiffness = 0.0;  // N/m
};

// Ties a node to a place: E = k |x - at|^2 / 2.
struct Pin {
  int node = 0;
  Vec3 at = Vec3::Zero();
  double stiffness = 0.0;  // N/m
};

class DrapeEnergy {
 public:
  // `cloth` and `contact` must outlive the energy; `contact` may be null. gravity: m/s^2 along -y, >= 0.
  DrapeEnergy(const Cloth& cloth, Contact* contact, double gravity);

  std::vector<Hold> holds;
  std::vector<Pin> pins;
  ClothContact* cloth_contact = nullptr;  // must outlive the energy; null: cloth passes through cloth
  Helper* helper = nullptr;               // must outlive the energy; null: one thread. The same bytes either way
  EdgeContact* edge_contact = nullptr;    // must outlive the energy; null: edges may lie in the body
  const NodeMirror* mirror = nullptr;     // must outlive the energy; not null: sought among symmetric positions alone
  // Must outlive the energy; not null: the cloth is this half of a symmetric garment, and so are nodes, holds and pins.
  // The energy is half that of both, and so are forces on the middle; those elsewhere are the same.
  const HalfCloth* half = nullptr;

  // Energy at `nodes` (#N x 3); `gradient` is overwritten, N.
  double evaluate(const Points3& nodes, Points3& gradient);

  // Second derivatives at `nodes`, friction as it is frozen; `hessian` is overwritten.
  void evaluate_hessian(const Points3& nodes, Curvature curvature, BlockHessian& hessian);

  // Root of the mean squared nodal gradient over the mean node weight: dimensionless, 0 at rest.
  double residual(const Points3& gradient) const;
  // Squared gradient at every node, those of the other half included, N^2.
  Eigen::VectorXd squared_forces(const Points3& gradient) const;

  const Cloth& cloth() const { return cloth_; }
  Contact* contact() const { return contact_; }

 private:
  double bending(const Points3& nodes, Points3& gradient) const;
  double gravity(const Points3& nodes, Points3& gradient) const;
  double ties(const Points3& nodes, Points3& gradient) const;

  const Cloth& cloth_;
  Contact* contact_;
  double gravity_;
  Points3 touching_;  // #N x 3, the part of the gradient that contact makes
};

}  // namespace toile
