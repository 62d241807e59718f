// SPDX-License-Identifier: GPL-3.0-or-later
// Limited-memory BFGS over node positions, started from a prefactored matrix instead of a multiple of the identity,
// with an Armijo line search and a cap on the largest move of a node. No allocation after construction. Sums run over
// the two halves of the nodes, which a helper may share: the same bytes with and without. Source: [Nocedal1980].
#pragma once

#include <functional>

#include "engine/core/helper.h"
#include "engine/core/types.h"
#include "engine/numerics/row_solver.h"

namespace toile {

struct QuasiNewtonOptions {
  int memory = 8;              // pairs kept, >= 1
  double largest_move = 0.03;  // of any node in one iteration, m
  double sufficient = 1e-4;    // Armijo: least share of the predicted decrease, (0, 0.5)
  int most_halvings = 30;      // of the step in one line search
};

class QuasiNewton {
 public:
  using Energy = std::function<double(const Points3& nodes, Points3& gradient)>;
  // Shortens a move, in which no node goes further than `longest` (m), so that it stays within what is allowed; the
  // move may turn a little. False: it was allowed as it is.
  using Limit = std::function<bool(const Points3& from, Points3& to, double longest)>;

  QuasiNewton(int node_count, const QuasiNewtonOptions& options);

  // Begins at `nodes`: evaluates there and forgets what was learnt.
  void start(const Points3& nodes, const Energy& energy);
  // The energy has changed its shape a little (friction frozen anew): evaluate again and keep what was learnt.
  void refresh(const Energy& energy);

  // One iteration with `matrix` (factored, #N x #N, one for all coordinates). False: no decrease can be found, the
  // nodes are as good as the arithmetic allows.
  bool step(const Energy& energy, RowSolver& matrix);

  // Applied to every trial of the line search; none by default.
  void set_limit(Limit limit) { limit_ = std::move(limit); }
  // Must outlive this; none by default.
  void set_helper(Helper* helper) { helper_ = helper; }

  const Points3& nodes() const { return nodes_; }
  const Points3& gradient() const { return gradient_; }
  double energy() const { return energy_; }
  int evaluations() const { return evaluations_; }

 private:
  template <class Work>
  void halves(const Work& work);  // work(half, first element, end) of both
  template <class Term>
  double sum_of(const Term& term);  // term(element) over all
  // Pairs are kept in single precision: they only shape the steps, and reading them is much of a step's cost.
  using Pairs = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  template <class Scalar>
  void look_along(const std::vector<Pairs>& pairs, const Scalar* vector);
  void add_pairs(const std::vector<Pairs>& pairs, double sign, Points3& vector);
  std::size_t slot(int pair) const { return static_cast<std::size_t>((first_ + pair) % options_.memory); }
  double product(int older, int newer) const {
    return products_(static_cast<Eigen::Index>(slot(older)), static_cast<Eigen::Index>(slot(newer)));
  }
  void find_direction(RowSolver& matrix);
  double longest_move();
  bool search_line(const Energy& energy);
  void remember();

  QuasiNewtonOptions options_;
  Limit limit_;
  Helper* helper_ = nullptr;

  Points3 nodes_, gradient_, trial_, trial_gradient_, direction_, right_;
  std::vector<Pairs> moves_, changes_;
  Eigen::MatrixXd products_;       // of an older pair's move with a newer one's change, by slots
  Eigen::VectorXd weight_, seen_;  // of the pairs from the oldest on
  Eigen::MatrixX2d along_;         // seen_ of either half
  int first_ = 0, count_ = 0;      // of the ring of pairs
  double energy_ = 0;
  int evaluations_ = 0;
};

}  // namespace toile
