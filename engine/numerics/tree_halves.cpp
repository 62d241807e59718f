// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/numerics/tree_halves.h"

#include <algorithm>
#include <cstdint>
#include <queue>

namespace toile {
namespace {

constexpr double kLargest = 0.2;  // of all work: larger subtrees are opened at their root

struct Subtree {
  std::int64_t work;
  int root;
  bool operator<(const Subtree& other) const {  // the queue's top: the most work, then the first
    return work != other.work ? work < other.work : root > other.root;
  }
};

enum Part { kFirst, kSecond, kTop };

}  // namespace

TreeHalves halve_tree(const std::vector<int>& parent, const std::vector<int>& work) {
  const std::size_t n = parent.size();
  std::vector<std::int64_t> sum(work.begin(), work.end());
  std::vector<std::vector<int>> children(n);
  std::priority_queue<Subtree> open;
  std::int64_t all = 0;
  for (std::size_t j = 0; j < n; ++j) {  // children come before their parents
    if (parent[j] < 0) {
      open.push({sum[j], static_cast<int>(j)});
      all += sum[j];
      continue;
    }
    sum[static_cast<std::size_t>(parent[j])] += sum[j];
    children[static_cast<std::size_t>(parent[j])].push_back(static_cast<int>(j));
  }
  std::vector<int> part(n, -1);
  while (!open.empty() && static_cast<double>(open.top().work) > kLargest * static_cast<double>(all)) {
    const auto root = static_cast<std::size_t>(open.top().root);
    open.pop();
    part[root] = kTop;
    for (const int child : children[root]) open.push({sum[static_cast<std::size_t>(child)], child});
  }
  std::int64_t load[2] = {0, 0};
  for (; !open.empty(); open.pop()) {  // the largest first, each to the half that has less
    const int half = load[1] < load[0] ? kSecond : kFirst;
    load[half] += open.top().work;
    part[static_cast<std::size_t>(open.top().root)] = half;
  }
  for (std::size_t j = n; j-- > 0;)
    if (part[j] < 0) part[j] = part[static_cast<std::size_t>(parent[j])];
  TreeHalves halves;
  halves.place.resize(n);
  int next = 0;
  for (const int which : {kFirst, kSecond, kTop}) {
    for (std::size_t j = 0; j < n; ++j)
      if (part[j] == which) halves.place[j] = next++;
    if (which == kFirst) halves.first_end = next;
    if (which == kSecond) halves.second_end = next;
  }
  return halves;
}

}  // namespace toile
