// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/quasi_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace toile {
namespace {

// A pair whose curvature is below this share of |move| |change| says nothing but rounding.
constexpr double kLeastCurvature = 1e-12;

double dot(const Points3& a, const Points3& b) {
  return a.cwiseProduct(b).sum();
}
template <class Pairs>
double dot(const Pairs& a, const Points3& b) {
  return a.template cast<double>().cwiseProduct(b).sum();
}

}  // namespace

QuasiNewton::QuasiNewton(int node_count, const QuasiNewtonOptions& options) : options_(options) {
  const auto m = static_cast<std::size_t>(options.memory);
  for (Points3* p : {&nodes_, &gradient_, &trial_, &trial_gradient_, &direction_, &right_}) p->setZero(node_count, 3);
  moves_.assign(m, Pairs::Zero(node_count, 3));
  changes_.assign(m, Pairs::Zero(node_count, 3));
  inverse_curvature_.assign(m, 0.0);
  weight_.assign(m, 0.0);
}

void QuasiNewton::start(const Points3& nodes, const Energy& energy) {
  nodes_ = nodes;
  count_ = 0;
  refresh(energy);
}

void QuasiNewton::refresh(const Energy& energy) {
  energy_ = energy(nodes_, gradient_);
  ++evaluations_;
}

void QuasiNewton::find_direction(RowSolver& matrix) {
  const auto slot = [&](int k) { return static_cast<std::size_t>((first_ + k) % options_.memory); };
  direction_ = -gradient_;
  for (int k = count_ - 1; k >= 0; --k) {
    const std::size_t s = slot(k);
    weight_[s] = inverse_curvature_[s] * dot(moves_[s], direction_);
    direction_ -= weight_[s] * changes_[s].cast<double>();
  }
  std::swap(direction_, right_);
  matrix.solve(right_, direction_);
  for (int k = 0; k < count_; ++k) {
    const std::size_t s = slot(k);
    const double correction = weight_[s] - inverse_curvature_[s] * dot(changes_[s], direction_);
    direction_ += correction * moves_[s].cast<double>();
  }
}

bool QuasiNewton::search_line(const Energy& energy) {
  const double slope = dot(gradient_, direction_);
  if (!(slope < 0)) return false;
  const double longest = std::sqrt(direction_.rowwise().squaredNorm().maxCoeff());
  double step = longest > options_.largest_move ? options_.largest_move / longest : 1.0;
  for (int i = 0; i <= options_.most_halvings; ++i, step *= 0.5) {
    trial_ = nodes_ + step * direction_;
    double predicted = step * slope;
    if (limit_) {
      limit_(nodes_, trial_);
      predicted = gradient_.cwiseProduct(trial_ - nodes_).sum();
      if (!(predicted < 0)) continue;
    }
    const double trial_energy = energy(trial_, trial_gradient_);
    ++evaluations_;
    if (trial_energy <= energy_ + options_.sufficient * predicted) {  // false for NaN
      energy_ = trial_energy;
      return true;
    }
  }
  return false;
}

void QuasiNewton::remember() {
  const auto s = static_cast<std::size_t>((first_ + count_) % options_.memory);
  moves_[s] = (trial_ - nodes_).cast<float>();
  changes_[s] = (trial_gradient_ - gradient_).cast<float>();
  const double curvature = moves_[s].cast<double>().cwiseProduct(changes_[s].cast<double>()).sum();
  const double size = static_cast<double>(moves_[s].norm()) * static_cast<double>(changes_[s].norm());
  if (!(curvature > kLeastCurvature * size)) return;
  inverse_curvature_[s] = 1 / curvature;
  if (count_ < options_.memory)
    ++count_;
  else
    first_ = (first_ + 1) % options_.memory;
}

bool QuasiNewton::step(const Energy& energy, RowSolver& matrix) {
  find_direction(matrix);
  bool moved = search_line(energy);
  if (!moved && count_ > 0) {  // what was learnt misleads: forget it and try once more
    count_ = 0;
    find_direction(matrix);
    moved = search_line(energy);
  }
  if (!moved) return false;
  remember();
  std::swap(nodes_, trial_);
  std::swap(gradient_, trial_gradient_);
  return true;
}

}  // namespace toile
