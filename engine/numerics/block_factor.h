// SPDX-License-Identifier: GPL-3.0-or-later
// A unit lower triangular factor in blocks of up to four neighbouring columns with nearly the same rows: substitution
// reads and writes a row once for all columns of its block. A few zeros fill the blocks up.
#pragma once

#include <cstdint>
#include <vector>

namespace toile {

// Three coordinates and one lane of padding.
using FactorRow = double __attribute__((vector_size(32)));

class BlockFactor {
 public:
  using Rows = std::vector<std::int32_t>;

  // `rows`: of every column, the rows below the diagonal, ascending. No block reaches over a column of `ends`
  // (ascending, the last one the number of columns). All values are zero then.
  void lay_out(const std::vector<Rows>& rows, const std::vector<int>& ends);
  // Values of the column, in the order of its rows.
  void set_column(int column, const Rows& rows, const double* values);

  // y = L^-1 y and y = L^-T y of columns `from` to `to`, each 0 or one of the ends: a row of `y` for every row named.
  void forward(int from, int to, FactorRow* y) const;
  void backward(int from, int to, FactorRow* y) const;

  struct Block {
    std::int32_t column, width, row_begin, row_count;
    std::size_t value_begin;  // of the triangle between its columns; a row of values for each of its rows follows
  };

 private:
  std::vector<Block> blocks_;
  std::vector<std::int32_t> block_of_;  // of every column, and their number at the end
  Rows rows_;
  std::vector<float> values_;
};

}  // namespace toile
