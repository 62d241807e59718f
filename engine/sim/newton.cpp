// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/newton.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace toile {
namespace {

// The weight of a node acts as a spring over this length in the matrix, times the residual: it bounds the steps along
// motions that cost nothing, and vanishes towards rest.
constexpr double kWeightLength = 3.0, kLeastShift = 1e-9;

constexpr double kSufficient = 1e-4;  // Armijo: least share of the predicted decrease
constexpr double kRounding = 1e-13;   // share of an energy below which a difference says nothing
constexpr int kMostTrials = 40;       // of the step in one line search
constexpr double kLeastShare = 1e-3;  // of the projection: below it the exact matrix is tried
constexpr double kShareStep = 4;

double dot(const Points3& a, const Points3& b) {
  return a.cwiseProduct(b).sum();
}

class Newton {
 public:
  Newton(DrapeEnergy& energy, const Points3& start, const NewtonOptions& options)
      : energy_(energy),
        options_(options),
        exact_(energy.cloth()),
        projected_(energy.cloth()),
        gradient_(start),
        trial_(start),
        trial_gradient_(start),
        direction_(start) {
    result_.nodes = start;
    result_.energy = energy_.evaluate(start, gradient_);
    result_.evaluations = 1;
    record();
  }

  NewtonResult run(Progress* progress) {
    while (result_.iterations < options_.iterations && !result_.converged && !result_.stalled) {
      check_cancelled(progress);
      report(progress, "drape", static_cast<double>(result_.iterations) / options_.iterations);
      if (find_direction() && search_line()) {
        ++result_.iterations;
        std::swap(result_.nodes, trial_);
        std::swap(gradient_, trial_gradient_);
        record();
      } else {
        result_.stalled = true;
      }
    }
    return result_;
  }

 private:
  void record() {
    result_.residual = energy_.residual(gradient_);
    result_.energies.push_back(result_.energy);
    result_.residuals.push_back(result_.residual);
    result_.converged = result_.residual < options_.stop_residual;
  }

  // Diagonal of the vanishing weight term.
  void add_shift(SparseMatrix& matrix) const {
    const Cloth& cloth = energy_.cloth();
    const double shift =
        std::clamp(result_.residual, kLeastShift, 1.0) * cloth.fabric.density * kGravity / kWeightLength;
    for (int i = 0; i < cloth.node_count; ++i)
      for (int d = 0; d < 3; ++d) matrix.coeffRef(3 * i + d, 3 * i + d) += shift * cloth.node_area[i];
  }

  // Factors the matrix with the least share of the projection, near the last one, that makes it positive definite.
  bool factor(const SparseMatrix& exact, const SparseMatrix& projected) {
    share_ = share_ / kShareStep < kLeastShare ? 0.0 : share_ / kShareStep;
    while (true) {
      SparseMatrix matrix = exact;
      for (Eigen::Index k = 0; k < matrix.nonZeros(); ++k)
        matrix.valuePtr()[k] += share_ * (projected.valuePtr()[k] - exact.valuePtr()[k]);
      add_shift(matrix);
      ++result_.factorisations;
      if (solver_.factor(matrix)) return true;
      if (share_ >= 1) return false;
      share_ = std::clamp(share_ * kShareStep, kLeastShare, 1.0);
    }
  }

  bool find_direction() {
    energy_.evaluate_hessian(result_.nodes, Curvature::Exact, exact_);
    energy_.evaluate_hessian(result_.nodes, Curvature::Projected, projected_);
    if (!factor(exact_.lower_triangle(), projected_.lower_triangle())) return false;
    const Eigen::Map<const Eigen::VectorXd> right(gradient_.data(), gradient_.size());
    Eigen::Map<Eigen::VectorXd>(direction_.data(), direction_.size()) = -solver_.solve(right);
    return direction_.allFinite();
  }

  // Whether the trial, `step` along the direction, is good enough.
  bool accepts(double trial_energy, double step, double slope) const {
    if (trial_energy <= result_.energy + kSufficient * step * slope) return true;  // false for NaN
    const bool rounding = trial_energy <= result_.energy + kRounding * std::abs(result_.energy);
    return rounding && dot(trial_gradient_, direction_) <= (2 * kSufficient - 1) * slope;
  }

  bool search_line() {
    const double slope = dot(gradient_, direction_);
    if (!(slope < 0)) return false;
    const double longest = std::sqrt(direction_.rowwise().squaredNorm().maxCoeff());
    double step = std::min(1.0, options_.largest_move / longest);
    for (int i = 0; i < kMostTrials; ++i) {
      trial_ = result_.nodes + step * direction_;
      const double trial_energy = energy_.evaluate(trial_, trial_gradient_);
      ++result_.evaluations;
      if (accepts(trial_energy, step, slope)) {
        result_.energy = trial_energy;
        return true;
      }
      const double rise = trial_energy - result_.energy - step * slope;  // of the parabola through both ends
      const double least = rise > 0 ? -0.5 * slope * step * step / rise : 0.5 * step;
      step = std::clamp(std::isfinite(least) ? least : 0.0, 0.1 * step, 0.5 * step);
    }
    return false;
  }

  DrapeEnergy& energy_;
  NewtonOptions options_;
  BlockHessian exact_, projected_;
  SparseSolver solver_;
  Points3 gradient_, trial_, trial_gradient_, direction_;
  double share_ = 1.0;
  NewtonResult result_;
};

}  // namespace

NewtonResult newton(DrapeEnergy& energy, const Points3& start, const NewtonOptions& options, Progress* progress) {
  return Newton(energy, start, options).run(progress);
}

}  // namespace toile
