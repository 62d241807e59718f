// SPDX-License-Identifier: GPL-3.0-or-later
// Union-find over 0..n-1: which things have become one.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace toile {

class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }

  // The smaller representative stays: the result does not depend on the order of joining.
  void join(int i, int j) {
    i = find(i), j = find(j);
    parent(std::max(i, j)) = std::min(i, j);
  }

  // Numbers 0.. in order of first appearance, and how many there are.
  std::pair<std::vector<int>, int> numbering() {
    std::vector<int> number(parent_.size(), -1);
    int count = 0;
    for (int i = 0; i < static_cast<int>(parent_.size()); ++i) {
      int& of_root = number[static_cast<std::size_t>(find(i))];
      if (of_root < 0) of_root = count++;
      number[static_cast<std::size_t>(i)] = of_root;
    }
    return {std::move(number), count};
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<int> parent_;
};

}  // namespace toile
