// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/contact.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

constexpr double kLeastSlope = 1e-12;  // of a field's gradient: it vanishes on the medial axis
// Of the way to contact, that a node may go without being looked up: fields are a little steeper than 1 in creases, and
// what they tell of distances beyond reach depends on what they were asked before.
constexpr double kSure = 0.9;
constexpr std::size_t kAhead = 8;  // nodes: memory takes as long as these

}  // namespace

double contact_profile(double depth, double linear_beyond, double& slope) {
  slope = std::clamp(depth, 0.0, linear_beyond);
  return slope * (depth > linear_beyond ? depth - 0.5 * linear_beyond : 0.5 * slope);
}

double friction_profile(double length, double slip_length, double& slope_over_length) {
  if (length >= slip_length) {
    slope_over_length = 1 / length;
    return length - slip_length / 3;
  }
  slope_over_length = (2 - length / slip_length) / slip_length;
  return length * length / slip_length * (1 - length / (3 * slip_length));
}

Contact::Contact(const Cloth& cloth, SignedField& field, const ContactOptions& options)
    : cloth_(cloth),
      field_(field),
      options_(options),
      distance_(Eigen::VectorXd::Zero(cloth.node_count)),
      looked_up_at_(Points3::Zero(cloth.node_count, 3)),
      known_(static_cast<std::size_t>(cloth.node_count), false),
      hint_(static_cast<std::size_t>(cloth.node_count), 0),
      taken_up_(Eigen::VectorXd::Zero(cloth.node_count)),
      load_(Eigen::VectorXd::Zero(cloth.node_count)),
      anchor_(Points3::Zero(cloth.node_count, 3)),
      normal_(Points3::Zero(cloth.node_count, 3)) {}

bool Contact::near(Eigen::Index i, const Vec3& p, Vec3& normal) {
  const double t = options_.thickness + taken_up_[i];
  const double clear = kSure * (distance_[i] - t);
  const Vec3 last = looked_up_at_.row(i);
  if (known_[static_cast<std::size_t>(i)] && clear > 0 && (p - last).squaredNorm() < clear * clear) return false;
  distance_[i] = field_.evaluate_again(p, t, normal, hint_[static_cast<std::size_t>(i)]);
  looked_up_at_.row(i) = p.transpose();
  known_[static_cast<std::size_t>(i)] = true;
  return distance_[i] < t;
}

double Contact::energy_gradient(const Points3& nodes, Points3& gradient) {
  double energy = 0;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    if (const std::size_t ahead = static_cast<std::size_t>(i) + kAhead; ahead < hint_.size())
      field_.prepare(hint_[ahead]);
    const Vec3 p = nodes.row(i);
    Vec3 normal;
    if (near(i, p, normal)) {
      double slope = 0;
      const double k = options_.stiffness * cloth_.node_area[i];
      energy += k * contact_profile(depth(i), options_.linear_beyond, slope);
      gradient.row(i) -= (k * slope * normal).transpose();
    }
    if (!frozen_ || load_[i] <= 0) continue;
    const Vec3 n = normal_.row(i), moved = p - anchor_.row(i).transpose(), slip = moved - n * n.dot(moved);
    double slope_over_length = 0;
    energy += load_[i] * friction_profile(slip.norm(), options_.slip_length, slope_over_length);
    gradient.row(i) += (load_[i] * slope_over_length * slip).transpose();
  }
  return energy;
}

void Contact::add_hessian(const Points3& nodes, Curvature curvature, BlockHessian& hessian) {
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const Vec3 p = nodes.row(i);
    const auto node = static_cast<int>(i);
    Vec3 normal;
    if (near(i, p, normal))
      hessian.add(node, node,
                  contact_hessian(options_.stiffness * cloth_.node_area[i], depth(i), options_.linear_beyond, normal,
                                  field_.hessian(p), curvature));
    if (!frozen_ || load_[i] <= 0) continue;
    const Vec3 n = normal_.row(i), moved = p - anchor_.row(i).transpose();
    hessian.add(node, node, friction_hessian(load_[i], options_.slip_length, moved - n * n.dot(moved), n));
  }
}

void Contact::start_friction(const FrictionState& state, bool for_good) {
  load_ = state.load, anchor_ = state.anchor, normal_ = state.normal;
  frozen_ = true;
  held_ = for_good;
}

void Contact::freeze_friction(const Points3& nodes) {
  freeze_friction(nodes, Points3::Zero(nodes.rows(), 3), 0.0);
}

void Contact::freeze_friction(const Points3& nodes, const Points3& pull, double reach) {
  if (held_) return;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const Vec3 p = nodes.row(i);
    Vec3 normal;
    const double kept = options_.thickness + taken_up_[i];
    const double sunk = kept - field_.evaluate(p, kept + reach, normal);
    if (options_.multipliers) taken_up_[i] = std::max(0.0, sunk);
    known_[static_cast<std::size_t>(i)] = false;
    const bool held = frozen_ && load_[i] > 0;
    load_[i] = 0;
    if (sunk <= -reach) continue;
    double slope = 0;
    contact_profile(sunk, options_.linear_beyond, slope);
    const double length = std::max(normal.norm(), kLeastSlope);
    normal /= length;
    const double pressed = options_.stiffness * cloth_.node_area[i] * slope * length;
    load_[i] = options_.friction * std::max(pressed, pull.row(i).dot(normal));
    normal_.row(i) = normal.transpose();
    anchor_.row(i) = (held ? dragged_anchor(i, p, normal) : p).transpose();
  }
  frozen_ = options_.friction > 0;
}

Vec3 Contact::dragged_anchor(Eigen::Index i, const Vec3& p, const Vec3& normal) const {
  const Vec3 moved = p - anchor_.row(i).transpose(), slip = moved - normal * normal.dot(moved);
  const double length = slip.norm();
  return p - slip * (length > options_.slip_length ? options_.slip_length / length : 1.0);
}

void Contact::stiffness_diagonal(Eigen::VectorXd& diagonal) const {
  for (Eigen::Index i = 0; i < distance_.size(); ++i)
    diagonal[i] = depth(i) > 0 ? options_.stiffness * cloth_.node_area[i] : 0.0;
}

}  // namespace toile
