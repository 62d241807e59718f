// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/drape_energy.h"

#include <algorithm>
#include <cmath>

#include "engine/sim/membrane.h"

namespace toile {

DrapeEnergy::DrapeEnergy(const Cloth& cloth, Contact* contact, double gravity)
    : cloth_(cloth), contact_(contact), gravity_(gravity) {}

// In two parts of about the same length, each with a gradient of its own.
double DrapeEnergy::evaluate(const Points3& nodes, Points3& gradient) {
  double cloth = 0, touching = 0;
  touching_.resize(nodes.rows(), 3);
  both(
      helper,
      [&] {
        gradient.setZero();
        cloth = membrane_energy_gradient(cloth_, nodes, gradient);
        cloth += bending(nodes, gradient);
      },
      [&] {
        touching_.setZero();
        touching = gravity(nodes, touching_) + ties(nodes, touching_);
        if (contact_) touching += contact_->energy_gradient(nodes, touching_);
        if (edge_contact) touching += edge_contact->energy_gradient(nodes, touching_);
        if (cloth_contact) touching += cloth_contact->energy_gradient(nodes, touching_);
      });
  gradient += touching_;
  cloth_.hold_middle(gradient);
  if (mirror) symmetrise(*mirror, gradient);
  return cloth + touching;
}

void DrapeEnergy::evaluate_hessian(const Points3& nodes, Curvature curvature, BlockHessian& hessian) {
  hessian.set_zero();
  add_membrane_hessian(cloth_, nodes, curvature, hessian);
  add_bending_hessian(cloth_, hessian);
  for (const Hold& hold : holds)
    if (nodes(hold.node, 1) < hold.height)
      hessian.add(hold.node, hold.node, Vec3(0, hold.stiffness, 0).asDiagonal().toDenseMatrix());
  for (const Pin& pin : pins) hessian.add(pin.node, pin.node, pin.stiffness * Mat3::Identity());
  if (contact_) contact_->add_hessian(nodes, curvature, hessian);
  if (edge_contact) edge_contact->add_hessian(nodes, curvature, hessian);
  if (cloth_contact) cloth_contact->pairs().add_hessian(nodes, hessian);
}

double DrapeEnergy::residual(const Points3& gradient) const {
  double squared = gradient.squaredNorm();
  for (const int i : cloth_.middle) squared += gradient.row(i).squaredNorm();  // half of the force squared is a quarter
  if (cloth_.half) squared *= 2;
  return std::sqrt(squared / cloth_.whole_node_count()) / cloth_.mean_node_weight();
}

Eigen::VectorXd DrapeEnergy::squared_forces(const Points3& gradient) const {
  Eigen::VectorXd squares = gradient.rowwise().squaredNorm();
  if (!cloth_.half) return squares;
  for (const int i : cloth_.middle) squares[i] *= 4;
  Eigen::VectorXd both(2 * squares.size());
  both << squares, squares;
  Eigen::Index count = squares.size();
  std::vector<bool> single(static_cast<std::size_t>(count), false);
  for (const int i : cloth_.middle) single[static_cast<std::size_t>(i)] = true;
  for (Eigen::Index i = 0; i < squares.size(); ++i)
    if (!single[static_cast<std::size_t>(i)]) both[count++] = squares[i];
  return both.head(count);
}

double DrapeEnergy::bending(const Points3& nodes, Points3& gradient) const {
  double energy = 0;
  const SparseMatrix& q = cloth_.bending;  // symmetric: a column is a row
  for (Eigen::Index i = 0; i < q.outerSize(); ++i) {
    double x = 0, y = 0, z = 0;
    for (SparseMatrix::InnerIterator it(q, i); it; ++it) {
      const double* p = nodes.data() + 3 * it.index();
      x += it.value() * p[0], y += it.value() * p[1], z += it.value() * p[2];
    }
    double* g = gradient.data() + 3 * i;
    const double* p = nodes.data() + 3 * i;
    g[0] += x, g[1] += y, g[2] += z;
    energy += 0.5 * (x * p[0] + y * p[1] + z * p[2]);
  }
  const SparseMatrix& across = cloth_.bending_across;
  for (Eigen::Index i = 0; i < across.outerSize(); ++i) {
    double x = 0;
    for (SparseMatrix::InnerIterator it(across, i); it; ++it) x += it.value() * nodes(it.index(), 0);
    gradient(i, 0) += x;
    energy += 0.5 * x * nodes(i, 0);
  }
  return energy;
}

double DrapeEnergy::gravity(const Points3& nodes, Points3& gradient) const {
  const double weight_per_area = cloth_.fabric.density * gravity_;
  gradient.col(1) += weight_per_area * cloth_.node_area;
  return weight_per_area * cloth_.node_area.dot(nodes.col(1));
}

double DrapeEnergy::ties(const Points3& nodes, Points3& gradient) const {
  double energy = 0;
  for (const Hold& hold : holds) {
    const double sunk = std::min(0.0, nodes(hold.node, 1) - hold.height);
    energy += 0.5 * hold.stiffness * sunk * sunk;
    gradient(hold.node, 1) += hold.stiffness * sunk;
  }
  for (const Pin& pin : pins) {
    const Vec3 off = nodes.row(pin.node).transpose() - pin.at;
    energy += 0.5 * pin.stiffness * off.squaredNorm();
    gradient.row(pin.node) += (pin.stiffness * off).transpose();
  }
  return energy;
}

}  // namespace toile
