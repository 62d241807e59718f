// SPDX-License-Identifier: GPL-3.0-or-later
// Parts an elimination tree into two halves of about the same work, whose columns need nothing of each other, and the
// top that both lead to.
#pragma once

#include <vector>

namespace toile {

struct TreeHalves {
  std::vector<int> place;  // new number of every column: first half, second half, top; each in the old order
  int first_end = 0, second_end = 0;
};

// `parent`: of every column, greater than its own number, or -1; `work`: of every column, > 0.
TreeHalves halve_tree(const std::vector<int>& parent, const std::vector<int>& work);

}  // namespace toile
