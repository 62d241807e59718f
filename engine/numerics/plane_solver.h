// SPDX-License-Identifier: GPL-3.0-or-later
// Solves, over and over, for points in the plane that pull at each other alike along x and y, and each of which is tied
// to its place by a 2 x 2 matrix of its own:
//   (K (x) I + diag(D_i)) x = b,   K symmetric, from links; D_i symmetric; the whole positive definite.
// Ordered (minimum degree) and analysed once; factored in blocks, L D L^T, as often as the ties change: for sheets of
// some hundred to some thousand points this takes a fraction of what a solver for any matrix does. One thread.
// Source: [Davis2005] (the up-looking factorisation).
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

class PlaneSolver {
 public:
  // One entry of K and its image; entries of one place are added up. a == b: on the diagonal.
  struct Link {
    int a, b;
    double weight;
  };

  PlaneSolver(int points, const std::vector<Link>& links);

  // `ties`: D_i, one per point. False if the whole is not positive definite or not finite: the solver is then unusable
  // until the next successful call.
  [[nodiscard]] bool factor(const std::vector<Mat2>& ties);

  // Both #N x 2. Requires a successful factor(). No allocation.
  void solve(const Points2& right, Points2& solution);

  int size() const { return static_cast<int>(order_.size()); }

 private:
  // In lanes of a vector register: a point, and a 2 x 2 matrix column by column.
  struct Point {
    using Lanes __attribute__((vector_size(16))) = double;
    Lanes lanes;
  };
  struct Block {
    Point::Lanes first, second;  // columns
  };

  void analyse();
  void lay_out_columns();
  static bool invert(const Block& pivot, Block& inverse);

  std::vector<int> order_;        // point of every row
  std::vector<double> diagonal_;  // of K, by row
  // Entries of K left of the diagonal, row by row.
  std::vector<int> links_begin_, link_column_;
  std::vector<double> link_weight_;
  // Columns that each row of L reaches, each after those it depends on; and L by columns.
  std::vector<int> reach_begin_, reach_, column_begin_, row_;
  std::vector<int> filled_;  // per column, while it is being factored
  std::vector<Block> below_, inverse_, work_;
  std::vector<Point> moved_;  // the right-hand side on its way to the solution
};

}  // namespace toile
