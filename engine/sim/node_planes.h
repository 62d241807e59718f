// SPDX-License-Identifier: GPL-3.0-or-later
// Planes that nodes may not cross, any number for a node: what keeps two layers of cloth apart however large a step is.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

class NodePlanes {
 public:
  void clear() { planes_.clear(), runs_.clear(); }
  // The node stays where normal . x >= offset.
  void add(int node, const Vec3& normal, double offset) { planes_.push_back({node, normal, offset}); }
  // Adds every plane's reflection across x = 0, for the opposite node: the limit of a symmetric move is symmetric then.
  void reflect(const std::vector<int>& image);
  // After the last was added, before limit(). `nodes` (#N x 3): where they are now.
  void sort(const Points3& nodes);
  int count() const { return static_cast<int>(planes_.size()); }

  // Shortens the moves from `from`, where all planes hold, to `to` (#N x 3) so that they still hold; a move may turn
  // along the planes. False: none was touched, no move is changed. No node of `to` is further than `moved` (m) from
  // where it was when the planes were sorted: planes further away are not looked at.
  bool limit(const Points3& from, Points3& to, double moved) const;

 private:
  struct Plane {
    int node;
    Vec3 normal;
    double offset;
  };
  struct Run {  // planes of one node
    std::size_t begin, end;
    int node;
    double clear;  // least distance of one of them when they were sorted, m
  };

  Vec3 limited(const Run& run, const Vec3& from, const Vec3& to, bool& touched) const;

  std::vector<Plane> planes_, sorted_;
  std::vector<Run> runs_;
  std::vector<std::size_t> begin_;  // per node, while sorting
};

}  // namespace toile
