// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/sewing.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/row_solver.h"
#include "engine/sim/bending.h"
#include "engine/sim/membrane.h"

namespace toile {
namespace {

constexpr int kCall = 50;  // iterations after which a helper that is not there is called again

class SewingSolver {
 public:
  SewingSolver(DrapeEnergy& energy, SignedField& field, double thickness, const Points3& start,
               const SewingOptions& options)
      : energy_(energy),
        field_(field),
        thickness_(thickness),
        options_(options),
        x_(energy.half ? energy.half->folded(start) : start),
        z_(x_),
        u_(x_),
        gradient_(x_),
        right_(x_.rows(), 3),
        solution_(x_.rows(), 3),
        hint_(static_cast<std::size_t>(x_.rows()), 0) {
    u_.setZero();
    push_all_out();
    energy_.evaluate(x_, gradient_);
  }

  void factor(double sigma) {
    const Cloth& cloth = energy_.cloth();
    weight_ = cloth.fabric.weft_stiffness * sigma * cloth.node_area;
    const Eigen::VectorXd bending = bending_bound(cloth.bending);
    SparseMatrix matrix = membrane_bound(cloth);
    for (Eigen::Index i = 0; i < weight_.size(); ++i) matrix.coeffRef(i, i) += weight_[i] + bending[i];
    for (const Hold& hold : energy_.holds) matrix.coeffRef(hold.node, hold.node) += hold.stiffness;
    if (!solver_.factor(matrix, cloth.middle))
      throw Error(ErrorCode::DrapeFailed, "garment",
                  "the cloth's stiffness matrix cannot be factored; check the fabric");
  }

  // Largest move of a node. Pushing out and the energy where the nodes have come need nothing of each other.
  double step(double relaxation) {
    right_ = -gradient_ + ((z_ - u_ - x_).array().colwise() * weight_.array()).matrix();
    solver_.solve(right_, solution_, &helper_);
    x_ += solution_;
    if (energy_.mirror) symmetrise(*energy_.mirror, x_);
    helper_.both([&] { draw_copies(relaxation); }, [&] { energy_.evaluate(x_, gradient_); });
    return std::sqrt(solution_.rowwise().squaredNorm().maxCoeff());
  }

  void call_helper() { helper_.call(); }
  Points3 nodes() const { return energy_.half ? energy_.half->unfolded(x_) : x_; }

 private:
  Vec3 push_out(Vec3 p, std::int32_t& hint) {
    for (int k = 0; k < options_.push_steps; ++k) {
      Vec3 normal;
      const double depth = thickness_ - field_.evaluate_again(p, thickness_, normal, hint);
      if (depth <= 0) break;
      p += std::min(depth, options_.push_cap) * normal / std::max(normal.norm(), 0.1);
    }
    return p;
  }
  // Draws the copies towards the nodes, and out of the body.
  void draw_copies(double relaxation) {
    for (Eigen::Index i = 0; i < x_.rows(); ++i) {
      const Vec3 q = relaxation * x_.row(i) + (1 - relaxation) * z_.row(i);
      const Vec3 pushed = push_out(q + u_.row(i).transpose(), hint_[static_cast<std::size_t>(i)]);
      u_.row(i) += (q - pushed).transpose();
      z_.row(i) = pushed.transpose();
    }
  }
  void push_all_out() {
    for (Eigen::Index i = 0; i < z_.rows(); ++i)
      z_.row(i) = push_out(z_.row(i), hint_[static_cast<std::size_t>(i)]).transpose();
  }

  DrapeEnergy& energy_;
  SignedField& field_;
  const double thickness_;
  const SewingOptions& options_;
  RowSolver solver_;
  Helper helper_;
  Points3 x_, z_, u_, gradient_, right_, solution_;
  std::vector<std::int32_t> hint_;  // #N, of the field
  Eigen::VectorXd weight_;
};

}  // namespace

SewingResult sew(DrapeEnergy& energy, SignedField& field, double thickness, const Points3& start,
                 const SewingOptions& options, Progress* progress) {
  SewingSolver solver(energy, field, thickness, start, options);
  SewingResult result;
  for (std::size_t s = 0; s < options.stages.size(); ++s) {
    const SewingStage& stage = options.stages[s];
    solver.factor(stage.sigma);
    for (int i = 0; i < stage.iterations; ++i) {
      check_cancelled(progress);
      if (result.iterations % kCall == 0) solver.call_helper();
      result.last_move = solver.step(stage.relaxation);
      ++result.iterations;
      if (s + 1 == options.stages.size() && result.last_move < options.stop_move) break;
    }
  }
  result.nodes = solver.nodes();
  return result;
}

}  // namespace toile
