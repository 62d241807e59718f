// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/tree_halves.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <gtest/gtest.h>

namespace toile {
namespace {

enum Part { kFirst, kSecond, kTop };

Part part_of(const TreeHalves& halves, std::size_t column) {
  const int place = halves.place[column];
  return place < halves.first_end ? kFirst : place < halves.second_end ? kSecond : kTop;
}

// A binary tree of so many levels, children before their parents.
std::vector<int> binary_tree(int levels) {
  const int n = (1 << levels) - 1;
  std::vector<int> parent(static_cast<std::size_t>(n), -1);
  for (int j = 0; j + 1 < n; ++j) parent[static_cast<std::size_t>(j)] = n - 1 - (n - 2 - j) / 2;
  return parent;
}

void expect_sound(const std::vector<int>& parent, const TreeHalves& halves) {
  std::vector<int> sorted = halves.place;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(parent.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  for (std::size_t j = 0; j < parent.size(); ++j) {
    if (parent[j] < 0) continue;
    const auto up = static_cast<std::size_t>(parent[j]);
    EXPECT_LT(halves.place[j], halves.place[up]);
    EXPECT_TRUE(part_of(halves, up) == kTop || part_of(halves, up) == part_of(halves, j)) << j;
  }
}

TEST(TreeHalves, HalvesABinaryTreeBelowItsTop) {
  const std::vector<int> parent = binary_tree(8);
  const TreeHalves halves = halve_tree(parent, std::vector<int>(parent.size(), 1));
  expect_sound(parent, halves);
  const int first = halves.first_end, second = halves.second_end - halves.first_end;
  EXPECT_EQ(first, second);
  EXPECT_GT(first, 100);
}

TEST(TreeHalves, WeighsColumnsByTheirWork) {
  const std::vector<int> work = {2, 1, 1, 1, 1, 1, 1, 1, 1};  // nine columns that need nothing of each other
  const TreeHalves halves = halve_tree(std::vector<int>(9, -1), work);
  EXPECT_EQ(halves.second_end, 9);
  std::array<int, 2> load = {0, 0};
  for (std::size_t j = 0; j < work.size(); ++j) load[part_of(halves, j)] += work[j];
  EXPECT_EQ(load, (std::array<int, 2>{5, 5}));
}

TEST(TreeHalves, LeavesAPathToTheTop) {
  std::vector<int> parent(40);
  std::iota(parent.begin(), parent.end(), 1);
  parent.back() = -1;
  const TreeHalves halves = halve_tree(parent, std::vector<int>(40, 3));
  expect_sound(parent, halves);
  EXPECT_EQ(part_of(halves, 39), kTop);
}

TEST(TreeHalves, TakesNothing) {
  EXPECT_TRUE(halve_tree({}, {}).place.empty());
}

}  // namespace
}  // namespace toile
