// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/block_factor.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

namespace toile {
namespace {

constexpr int kMostColumns = 4;
constexpr double kMostZeros = 0.25;  // of a block's values

using Block = BlockFactor::Block;

std::size_t value_count(std::size_t width, std::size_t rows) {
  return width * (width - 1) / 2 + width * rows;
}

// Place of the value in column `b` of the block's triangle, right of its column `a`.
std::size_t triangle_place(std::size_t a, std::size_t b) {
  return b * (b - 1) / 2 + a;
}

template <int W>
[[gnu::always_inline]] inline void forward_block(const Block& block, const std::int32_t* rows, const float* values,
                                                 FactorRow* y) {
  FactorRow x[W];
  for (int b = 0; b < W; ++b) {
    x[b] = y[block.column + b];
    for (int a = 0; a < b; ++a) x[b] -= static_cast<double>(*values++) * x[a];
    y[block.column + b] = x[b];
  }
  for (std::int32_t i = 0; i < block.row_count; ++i, values += W) {
    FactorRow sum = static_cast<double>(values[0]) * x[0];
    for (int a = 1; a < W; ++a) sum += static_cast<double>(values[a]) * x[a];
    y[rows[i]] -= sum;
  }
}

template <int W>
[[gnu::always_inline]] inline void backward_block(const Block& block, const std::int32_t* rows, const float* values,
                                                  FactorRow* y) {
  FactorRow x[W];
  for (int a = 0; a < W; ++a) x[a] = y[block.column + a];
  const float* value = values + W * (W - 1) / 2;
  for (std::int32_t i = 0; i < block.row_count; ++i, value += W) {
    const FactorRow below = y[rows[i]];
    for (int a = 0; a < W; ++a) x[a] -= static_cast<double>(value[a]) * below;
  }
  for (int b = W; b-- > 0;) {
    y[block.column + b] = x[b];
    for (int a = 0; a < b; ++a) x[a] -= static_cast<double>(values[b * (b - 1) / 2 + a]) * x[b];
  }
}

// Calls `work` with the width as a constant, so that a block's loops over its columns unroll.
template <class Work>
[[gnu::always_inline]] inline void with_width(std::int32_t width, Work&& work) {
  static_assert(kMostColumns == 4);
  switch (width) {
    case 1: return work(std::integral_constant<int, 1>());
    case 2: return work(std::integral_constant<int, 2>());
    case 3: return work(std::integral_constant<int, 3>());
    default: return work(std::integral_constant<int, 4>());
  }
}

// Rows of a block with one more column after it; `rows` begins with that column, if it may join at all.
BlockFactor::Rows joined(const BlockFactor::Rows& rows, const BlockFactor::Rows& next) {
  BlockFactor::Rows all;
  std::set_union(rows.begin() + 1, rows.end(), next.begin(), next.end(), std::back_inserter(all));
  return all;
}

}  // namespace

void BlockFactor::lay_out(const std::vector<Rows>& rows, const std::vector<int>& ends) {
  blocks_.clear();
  block_of_.clear();
  rows_.clear();
  std::size_t begin = 0, values = 0;
  for (const int end_column : ends) {
    const auto end = static_cast<std::size_t>(end_column);
    while (begin < end) {
      Rows shared = rows[begin];
      std::size_t width = 1, entries = shared.size();
      while (width < kMostColumns && begin + width < end && !shared.empty() &&
             static_cast<std::size_t>(shared.front()) == begin + width) {
        Rows wider = joined(shared, rows[begin + width]);
        const std::size_t more = entries + rows[begin + width].size(), room = value_count(width + 1, wider.size());
        if (static_cast<double>(room - more) > kMostZeros * static_cast<double>(room)) break;
        shared = std::move(wider), entries = more, ++width;
      }
      block_of_.insert(block_of_.end(), width, static_cast<std::int32_t>(blocks_.size()));
      blocks_.push_back({static_cast<std::int32_t>(begin), static_cast<std::int32_t>(width),
                         static_cast<std::int32_t>(rows_.size()), static_cast<std::int32_t>(shared.size()), values});
      rows_.insert(rows_.end(), shared.begin(), shared.end());
      values += value_count(width, shared.size());
      begin += width;
    }
  }
  block_of_.push_back(static_cast<std::int32_t>(blocks_.size()));
  values_.assign(values, 0);
}

void BlockFactor::set_column(int column, const Rows& rows, const double* values) {
  const Block& block = blocks_[static_cast<std::size_t>(block_of_[static_cast<std::size_t>(column)])];
  const auto a = static_cast<std::size_t>(column - block.column), width = static_cast<std::size_t>(block.width);
  float* triangle = values_.data() + block.value_begin;
  float* own = triangle + width * (width - 1) / 2 + a;
  const std::int32_t* at = rows_.data() + block.row_begin;
  for (const std::int32_t row : rows) {
    const auto value = static_cast<float>(*values++);
    if (row < block.column + block.width) {
      triangle[triangle_place(a, static_cast<std::size_t>(row - block.column))] = value;
      continue;
    }
    for (; *at < row; ++at) own += width;
    *own = value;
  }
}

void BlockFactor::forward(int from, int to, FactorRow* y) const {
  const std::int32_t last = block_of_[static_cast<std::size_t>(to)];
  for (std::int32_t k = block_of_[static_cast<std::size_t>(from)]; k < last; ++k) {
    const Block& block = blocks_[static_cast<std::size_t>(k)];
    with_width(block.width, [&](auto width) {
      forward_block<width>(block, rows_.data() + block.row_begin, values_.data() + block.value_begin, y);
    });
  }
}

void BlockFactor::backward(int from, int to, FactorRow* y) const {
  const std::int32_t first = block_of_[static_cast<std::size_t>(from)];
  for (std::int32_t k = block_of_[static_cast<std::size_t>(to)]; k-- > first;) {
    const Block& block = blocks_[static_cast<std::size_t>(k)];
    with_width(block.width, [&](auto width) {
      backward_block<width>(block, rows_.data() + block.row_begin, values_.data() + block.value_begin, y);
    });
  }
}

}  // namespace toile
