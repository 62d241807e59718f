// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/quasi_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace toile {
namespace {

// A pair whose curvature is below this share of |move| |change| says nothing but rounding.
constexpr double kLeastCurvature = 1e-12;

// Of rows `begin` to `begin + rows`; `a` and `b` may be of either precision.
template <class A, class B>
double dot(const A& a, const B& b, Eigen::Index begin, Eigen::Index rows) {
  return a.middleRows(begin, rows)
      .template cast<double>()
      .cwiseProduct(b.middleRows(begin, rows).template cast<double>())
      .sum();
}

}  // namespace

template <class Work>
double QuasiNewton::halves(const Work& work) {
  const Eigen::Index rows = nodes_.rows(), middle = rows / 2;
  double first = 0, second = 0;
  both(
      helper_, [&] { first = work(Eigen::Index{0}, middle); }, [&] { second = work(middle, rows - middle); });
  return first + second;
}

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

// Every pass over the nodes takes away what one pair says and measures what the next one will.
void QuasiNewton::find_direction(RowSolver& matrix) {
  const auto slot = [&](int k) { return static_cast<std::size_t>((first_ + k) % options_.memory); };
  double along = halves([&](Eigen::Index begin, Eigen::Index rows) {
    auto part = direction_.middleRows(begin, rows);
    part = -gradient_.middleRows(begin, rows);
    return count_ > 0 ? dot(moves_[slot(count_ - 1)], direction_, begin, rows) : 0.0;
  });
  for (int k = count_ - 1; k >= 0; --k) {
    const std::size_t s = slot(k);
    weight_[s] = inverse_curvature_[s] * along;
    along = halves([&](Eigen::Index begin, Eigen::Index rows) {
      direction_.middleRows(begin, rows) -= weight_[s] * changes_[s].middleRows(begin, rows).cast<double>();
      return k > 0 ? dot(moves_[slot(k - 1)], direction_, begin, rows) : 0.0;
    });
  }
  std::swap(direction_, right_);
  matrix.solve(right_, direction_, helper_);
  if (count_ == 0) return;
  along =
      halves([&](Eigen::Index begin, Eigen::Index rows) { return dot(changes_[slot(0)], direction_, begin, rows); });
  for (int k = 0; k < count_; ++k) {
    const std::size_t s = slot(k);
    const double correction = weight_[s] - inverse_curvature_[s] * along;
    along = halves([&](Eigen::Index begin, Eigen::Index rows) {
      direction_.middleRows(begin, rows) += correction * moves_[s].middleRows(begin, rows).cast<double>();
      return k + 1 < count_ ? dot(changes_[slot(k + 1)], direction_, begin, rows) : 0.0;
    });
  }
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
  const double slope =
      halves([&](Eigen::Index begin, Eigen::Index rows) { return dot(gradient_, direction_, begin, rows); });
  if (!(slope < 0)) return false;
  const double longest = longest_move();
  double step = longest > options_.largest_move ? options_.largest_move / longest : 1.0;
  for (int i = 0; i <= options_.most_halvings; ++i, step *= 0.5) {
    trial_ = nodes_ + step * direction_;
    double predicted = step * slope;
    if (limit_) {
      limit_(nodes_, trial_);
      predicted = halves([&](Eigen::Index begin, Eigen::Index rows) {
        return gradient_.middleRows(begin, rows)
            .cwiseProduct(trial_.middleRows(begin, rows) - nodes_.middleRows(begin, rows))
            .sum();
      });
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
  const double curvature = halves([&](Eigen::Index begin, Eigen::Index rows) {
    moves_[s].middleRows(begin, rows) = (trial_.middleRows(begin, rows) - nodes_.middleRows(begin, rows)).cast<float>();
    changes_[s].middleRows(begin, rows) =
        (trial_gradient_.middleRows(begin, rows) - gradient_.middleRows(begin, rows)).cast<float>();
    return dot(moves_[s], changes_[s], begin, rows);
  });
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
