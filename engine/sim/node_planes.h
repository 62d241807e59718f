// SPDX-License-Identifier: GPL-3.0-or-later
// Planes that nodes may not cross, any number for a node: what keeps two layers of cloth apart however large a step is.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

class NodePlanes {
 public:
  void clear() { planes_.clear(); }
  // The node stays where normal . x >= offset.
  void add(int node, const Vec3& normal, double offset) { planes_.push_back({node, normal, offset}); }
  // Adds every plane's reflection across x = 0, for the opposite node: the limit of a symmetric move is symmetric then.
  void reflect(const std::vector<int>& image);
  void sort(int node_count);  // after the last was added, before limit()
  int count() const { return static_cast<int>(planes_.size()); }

  // Shortens the moves from `from`, where all planes hold, to `to` (#N x 3) so that they still hold; a move may turn
  // along the planes. False: none was touched.
  bool limit(const Points3& from, Points3& to) const;

 private:
  struct Plane {
    int node;
    Vec3 normal;
    double offset;
  };
  using Run = std::pair<std::size_t, std::size_t>;  // of one node's planes

  Vec3 limited(const Run& run, const Vec3& from, const Vec3& to, bool& touched) const;

  std::vector<Plane> planes_, sorted_;
  std::vector<std::size_t> begin_;  // per node, while sorting
};

}  // namespace toile
