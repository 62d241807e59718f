// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/plane_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/OrderingMethods>
#include <Eigen/Sparse>

namespace toile {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix summed(int points, const std::vector<PlaneSolver::Link>& links) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * links.size());
  for (const PlaneSolver::Link& link : links) {
    entries.emplace_back(link.a, link.b, link.weight);
    if (link.a != link.b) entries.emplace_back(link.b, link.a, link.weight);
  }
  Matrix matrix(points, points);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

PlaneSolver::PlaneSolver(int points, const std::vector<Link>& links) {
  const Matrix matrix = summed(points, links);
  Eigen::AMDOrdering<int>::PermutationType pivots;
  if (points > 0) Eigen::AMDOrdering<int>()(matrix, pivots);
  order_.assign(pivots.indices().data(), pivots.indices().data() + pivots.size());
  std::vector<int> place(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) place[static_cast<std::size_t>(order_[k])] = static_cast<int>(k);
  diagonal_.assign(order_.size(), 0.0);
  links_begin_ = {0};
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (Matrix::InnerIterator it(matrix, order_[k]); it; ++it) {
      const int column = place[static_cast<std::size_t>(it.index())];
      if (column == static_cast<int>(k)) diagonal_[k] = it.value();
      if (column >= static_cast<int>(k)) continue;
      link_column_.push_back(column);
      link_weight_.push_back(it.value());
    }
    links_begin_.push_back(static_cast<int>(link_column_.size()));
  }
  analyse();
}

// The elimination tree gives the columns of every row of L [Davis2005].
void PlaneSolver::analyse() {
  const std::size_t n = order_.size();
  std::vector<int> parent(n, -1), seen(n, -1), path, reversed;
  reach_begin_ = {0};
  for (std::size_t k = 0; k < n; ++k) {
    const int row = static_cast<int>(k);
    seen[k] = row;
    reversed.clear();
    for (int l = links_begin_[k]; l < links_begin_[k + 1]; ++l) {
      path.clear();
      for (auto i = static_cast<std::size_t>(link_column_[static_cast<std::size_t>(l)]); seen[i] != row;
           i = static_cast<std::size_t>(parent[i])) {
        path.push_back(static_cast<int>(i));
        seen[i] = row;
        if (parent[i] < 0) parent[i] = row;
      }
      reversed.insert(reversed.end(), path.rbegin(), path.rend());
    }
    reach_.insert(reach_.end(), reversed.rbegin(), reversed.rend());
    reach_begin_.push_back(static_cast<int>(reach_.size()));
  }
  lay_out_columns();
}

void PlaneSolver::lay_out_columns() {
  const std::size_t n = order_.size();
  column_begin_.assign(n + 1, 0);
  for (const int column : reach_) ++column_begin_[static_cast<std::size_t>(column) + 1];
  for (std::size_t k = 0; k < n; ++k) column_begin_[k + 1] += column_begin_[k];
  row_.resize(reach_.size());
  filled_.assign(n, 0);
  for (std::size_t k = 0; k < n; ++k)
    for (int r = reach_begin_[k]; r < reach_begin_[k + 1]; ++r) {
      const auto i = static_cast<std::size_t>(reach_[static_cast<std::size_t>(r)]);
      row_[static_cast<std::size_t>(column_begin_[i] + filled_[i]++)] = static_cast<int>(k);
    }
  below_.resize(row_.size());
  inverse_.resize(n);
  work_.assign(n, Block{});
  moved_.resize(n);
}

bool PlaneSolver::factor(const std::vector<Mat2>& ties) {
  assert(ties.size() == order_.size());
  std::fill(filled_.begin(), filled_.end(), 0);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const Mat2& tie = ties[static_cast<std::size_t>(order_[k])];
    Block pivot = {{tie(0, 0) + diagonal_[k], tie(1, 0)}, {tie(0, 1), tie(1, 1) + diagonal_[k]}};
    for (int l = links_begin_[k]; l < links_begin_[k + 1]; ++l) {
      const double w = link_weight_[static_cast<std::size_t>(l)];
      work_[static_cast<std::size_t>(link_column_[static_cast<std::size_t>(l)])] = Block{{w, 0.0}, {0.0, w}};
    }
    for (int r = reach_begin_[k]; r < reach_begin_[k + 1]; ++r) {
      const auto i = static_cast<std::size_t>(reach_[static_cast<std::size_t>(r)]);
      const Block y = work_[i];
      work_[i] = Block{};
      const auto begin = static_cast<std::size_t>(column_begin_[i]), end = begin + static_cast<std::size_t>(filled_[i]);
      for (std::size_t p = begin; p < end; ++p) {
        Block& to = work_[static_cast<std::size_t>(row_[p])];
        const Block& l = below_[p];
        to.first -= l.first * y.first[0] + l.second * y.first[1];
        to.second -= l.first * y.second[0] + l.second * y.second[1];
      }
      // The row's entry is the transpose of y times the inverse pivot, which is symmetric.
      const Block& d = inverse_[i];
      const Block entry = {
          {y.first[0] * d.first[0] + y.first[1] * d.first[1], y.second[0] * d.first[0] + y.second[1] * d.first[1]},
          {y.first[0] * d.second[0] + y.first[1] * d.second[1], y.second[0] * d.second[0] + y.second[1] * d.second[1]}};
      pivot.first -= entry.first * y.first[0] + entry.second * y.first[1];
      pivot.second -= entry.first * y.second[0] + entry.second * y.second[1];
      below_[end] = entry;
      ++filled_[i];
    }
    if (!invert(pivot, inverse_[k])) {
      std::fill(work_.begin(), work_.end(), Block{});
      return false;
    }
  }
  return true;
}

bool PlaneSolver::invert(const Block& pivot, Block& inverse) {
  const double determinant = pivot.first[0] * pivot.second[1] - pivot.first[1] * pivot.second[0];
  if (!(pivot.first[0] > 0.0) || !(determinant > 0.0) || !std::isfinite(determinant)) return false;
  const double share = 1.0 / determinant;
  inverse =
      Block{{pivot.second[1] * share, -pivot.first[1] * share}, {-pivot.second[0] * share, pivot.first[0] * share}};
  return true;
}

void PlaneSolver::solve(const Points2& right, Points2& solution) {
  const std::size_t n = order_.size();
  assert(static_cast<std::size_t>(right.rows()) == n && solution.rows() == right.rows());
  for (std::size_t k = 0; k < n; ++k) moved_[k] = Point{{right(order_[k], 0), right(order_[k], 1)}};
  for (std::size_t k = 0; k < n; ++k) {
    const double x = moved_[k].lanes[0], y = moved_[k].lanes[1];
    for (auto p = static_cast<std::size_t>(column_begin_[k]); p < static_cast<std::size_t>(column_begin_[k + 1]); ++p)
      moved_[static_cast<std::size_t>(row_[p])].lanes -= below_[p].first * x + below_[p].second * y;
  }
  for (std::size_t k = n; k-- > 0;) {
    Point::Lanes first{}, second{};
    for (auto p = static_cast<std::size_t>(column_begin_[k]); p < static_cast<std::size_t>(column_begin_[k + 1]); ++p) {
      const Point::Lanes known = moved_[static_cast<std::size_t>(row_[p])].lanes;
      first += below_[p].first * known;
      second += below_[p].second * known;
    }
    const Block& d = inverse_[k];
    moved_[k].lanes = d.first * moved_[k].lanes[0] + d.second * moved_[k].lanes[1] -
                      Point::Lanes{first[0] + first[1], second[0] + second[1]};
    solution.row(order_[k]) << moved_[k].lanes[0], moved_[k].lanes[1];
  }
}

}  // namespace toile
