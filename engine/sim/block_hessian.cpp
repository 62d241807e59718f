// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/block_hessian.h"

#include <algorithm>

namespace toile {
namespace {

using Pair = std::pair<int, int>;  // column, row

std::vector<Pair> cloth_pairs(const Cloth& cloth) {
  std::vector<Pair> pairs;
  for (int i = 0; i < cloth.node_count; ++i) pairs.emplace_back(i, i);
  for (const TriangleBlock& block : cloth.blocks)
    for (std::size_t l = 0; l < kLanes; ++l)
      for (std::size_t k = 0; k < 3; ++k) pairs.push_back(std::minmax({block.node[k][l], block.node[(k + 1) % 3][l]}));
  for (int j = 0; j < cloth.bending.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(cloth.bending, j); it; ++it)
      if (it.index() > j) pairs.emplace_back(j, static_cast<int>(it.index()));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// The lower triangle of a block on the diagonal, all of it below.
template <class Take>
void entries_of(int row, int column, const Mat3& block, const Take& take) {
  for (int c = 0; c < 3; ++c)
    for (int r = row == column ? c : 0; r < 3; ++r) take(3 * row + r, 3 * column + c, block(r, c));
}

}  // namespace

BlockHessian::BlockHessian(const Cloth& cloth) {
  const std::vector<Pair> pairs = cloth_pairs(cloth);
  begin_.assign(static_cast<std::size_t>(cloth.node_count) + 1, 0);
  row_.reserve(pairs.size());
  for (const auto& [column, row] : pairs) {
    ++begin_[static_cast<std::size_t>(column) + 1];
    row_.push_back(row);
  }
  for (std::size_t j = 1; j < begin_.size(); ++j) begin_[j] += begin_[j - 1];
  block_.assign(row_.size(), Mat3::Zero());
}

void BlockHessian::set_zero() {
  std::fill(block_.begin(), block_.end(), Mat3::Zero());
  further_.clear();
}

void BlockHessian::add(int i, int j, const Mat3& block) {
  const auto [column, row] = std::minmax(i, j);
  const Mat3 below = i >= j ? block : Mat3(block.transpose());
  const auto first = row_.begin() + begin_[static_cast<std::size_t>(column)],
             last = row_.begin() + begin_[static_cast<std::size_t>(column) + 1];
  const auto found = std::lower_bound(first, last, row);
  if (found != last && *found == row)
    block_[static_cast<std::size_t>(found - row_.begin())] += below;
  else
    further_.try_emplace({column, row}, Mat3::Zero()).first->second += below;
}

SparseMatrix BlockHessian::lower_triangle() const {
  SparseMatrix matrix(3 * node_count(), 3 * node_count());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * (block_.size() + further_.size()));
  const auto take = [&](int row, int column, double value) { entries.emplace_back(row, column, value); };
  for (int j = 0; j < node_count(); ++j)
    for (int k = begin_[static_cast<std::size_t>(j)]; k < begin_[static_cast<std::size_t>(j) + 1]; ++k)
      entries_of(row_[static_cast<std::size_t>(k)], j, block_[static_cast<std::size_t>(k)], take);
  for (const auto& [at, block] : further_) entries_of(at.second, at.first, block, take);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Points3 BlockHessian::times(const Points3& directions) const {
  Points3 product = Points3::Zero(directions.rows(), 3);
  const auto take = [&](int row, int column, const Mat3& block) {
    product.row(row) += (block * directions.row(column).transpose()).transpose();
    if (row != column) product.row(column) += (block.transpose() * directions.row(row).transpose()).transpose();
  };
  for (int j = 0; j < node_count(); ++j)
    for (int k = begin_[static_cast<std::size_t>(j)]; k < begin_[static_cast<std::size_t>(j) + 1]; ++k)
      take(row_[static_cast<std::size_t>(k)], j, block_[static_cast<std::size_t>(k)]);
  for (const auto& [at, block] : further_) take(at.second, at.first, block);
  return product;
}

}  // namespace toile
