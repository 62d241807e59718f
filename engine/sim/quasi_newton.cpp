// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/quasi_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace toile {
namespace {

// A pair whose curvature is below this share of |move| |change| says nothing but rounding.
constexpr double kLeastCurvature = 1e-12;

// Elements worked on at a time: they stay in the first cache while all pairs pass by.
constexpr Eigen::Index kChunk = 768;

// In eight sums: none waits for the last addition of another.
template <class Term>
double sum(Eigen::Index begin, Eigen::Index end, const Term& term) {
  double lanes[8] = {};
  Eigen::Index i = begin;
  for (; i + 8 <= end; i += 8)
    for (int lane = 0; lane < 8; ++lane) lanes[lane] += term(i + lane);
  for (int lane = 0; i < end; ++i, ++lane) lanes[lane] += term(i);
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

// y += factor x
void add(double factor, const float* x, double* y, Eigen::Index begin, Eigen::Index end) {
  for (Eigen::Index i = begin; i < end; ++i) y[i] += factor * static_cast<double>(x[i]);
}

template <class Work>
void in_chunks(Eigen::Index begin, Eigen::Index end, const Work& work) {
  for (Eigen::Index at = begin; at < end; at += kChunk) work(at, std::min(at + kChunk, end));
}

}  // namespace

template <class Work>
void QuasiNewton::halves(const Work& work) {
  const Eigen::Index size = nodes_.size(), middle = nodes_.rows() / 2 * 3;
  both(
      helper_, [&] { work(0, Eigen::Index{0}, middle); }, [&] { work(1, middle, size); });
}

template <class Term>
double QuasiNewton::sum_of(const Term& term) {
  double parts[2] = {};
  halves([&](int half, Eigen::Index begin, Eigen::Index end) { parts[half] = sum(begin, end, term); });
  return parts[0] + parts[1];
}

QuasiNewton::QuasiNewton(int node_count, const QuasiNewtonOptions& options) : options_(options) {
  const auto m = static_cast<std::size_t>(options.memory);
  for (Points3* p : {&nodes_, &gradient_, &trial_, &trial_gradient_, &direction_, &right_}) p->setZero(node_count, 3);
  moves_.assign(m, Pairs::Zero(node_count, 3));
  changes_.assign(m, Pairs::Zero(node_count, 3));
  products_.setZero(options.memory, options.memory);
  for (Eigen::VectorXd* p : {&weight_, &seen_}) p->setZero(options.memory);
  along_.setZero(options.memory, 2);
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

// Of one part of every pair, from the oldest on, with a vector.
template <class Scalar>
void QuasiNewton::look_along(const std::vector<Pairs>& pairs, const Scalar* vector) {
  along_.setZero();
  halves([&](int half, Eigen::Index begin, Eigen::Index end) {
    in_chunks(begin, end, [&](Eigen::Index from, Eigen::Index to) {
      for (int k = 0; k < count_; ++k) {
        const float* pair = pairs[slot(k)].data();
        along_(k, half) += sum(
            from, to, [&](Eigen::Index i) { return static_cast<double>(pair[i]) * static_cast<double>(vector[i]); });
      }
    });
  });
  seen_ = along_.col(0) + along_.col(1);
}

// vector += sum of factors times pairs
void QuasiNewton::add_pairs(const std::vector<Pairs>& pairs, double sign, Points3& vector) {
  halves([&](int, Eigen::Index begin, Eigen::Index end) {
    in_chunks(begin, end, [&](Eigen::Index from, Eigen::Index to) {
      for (int k = 0; k < count_; ++k) add(sign * weight_[k], pairs[slot(k)].data(), vector.data(), from, to);
    });
  });
}

// The two loops of the recursion, with the products of all pairs at hand: what a pair sees of a vector that others have
// changed is what it sees of the vector and of their changes. So the nodes are passed four times, not twice a pair.
void QuasiNewton::find_direction(RowSolver& matrix) {
  look_along(moves_, gradient_.data());
  for (int k = count_ - 1; k >= 0; --k) {
    double along = -seen_[k];
    for (int newer = k + 1; newer < count_; ++newer) along -= weight_[newer] * product(k, newer);
    weight_[k] = along / product(k, k);
  }
  right_ = -gradient_;
  add_pairs(changes_, -1, right_);
  matrix.solve(right_, direction_, helper_);
  look_along(changes_, direction_.data());
  for (int k = 0; k < count_; ++k) {
    double along = seen_[k];
    for (int older = 0; older < k; ++older) along += weight_[older] * product(older, k);
    weight_[k] -= along / product(k, k);
  }
  add_pairs(moves_, 1, direction_);
}

double QuasiNewton::longest_move() {
  const Eigen::Index rows = nodes_.rows(), middle = rows / 2;
  double first = 0, second = 0;
  const auto longest = [&](Eigen::Index begin, Eigen::Index count) {
    return count > 0 ? direction_.middleRows(begin, count).rowwise().squaredNorm().maxCoeff() : 0.0;
  };
  both(
      helper_, [&] { first = longest(0, middle); }, [&] { second = longest(middle, rows - middle); });
  return std::sqrt(std::max(first, second));
}

bool QuasiNewton::search_line(const Energy& energy) {
  const double *g = gradient_.data(), *d = direction_.data(), *from = nodes_.data();
  const double slope = sum_of([&](Eigen::Index i) { return g[i] * d[i]; });
  if (!(slope < 0)) return false;
  const double longest = longest_move();
  double step = longest > options_.largest_move ? options_.largest_move / longest : 1.0;
  for (int halving = 0; halving <= options_.most_halvings; ++halving, step *= 0.5) {
    trial_ = nodes_ + step * direction_;
    double predicted = step * slope;
    if (limit_ && limit_(nodes_, trial_, step * longest)) {
      const double* to = trial_.data();
      predicted = sum_of([&](Eigen::Index i) { return g[i] * (to[i] - from[i]); });
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
  const std::size_t newest = slot(count_);  // the oldest one's, where all are taken
  float *move = moves_[newest].data(), *change = changes_[newest].data();
  const double *from = nodes_.data(), *to = trial_.data(), *before = gradient_.data(), *after = trial_gradient_.data();
  halves([&](int, Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      move[i] = static_cast<float>(to[i] - from[i]);
      change[i] = static_cast<float>(after[i] - before[i]);
    }
  });
  if (count_ == options_.memory) first_ = (first_ + 1) % options_.memory, --count_;
  ++count_;
  look_along(moves_, change);
  const double size = static_cast<double>(moves_[newest].norm()) * static_cast<double>(changes_[newest].norm());
  if (!(seen_[count_ - 1] > kLeastCurvature * size)) {
    --count_;
    return;
  }
  for (int k = 0; k < count_; ++k)
    products_(static_cast<Eigen::Index>(slot(k)), static_cast<Eigen::Index>(newest)) = seen_[k];
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
