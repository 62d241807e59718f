// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/node_planes.h"

#include <algorithm>
#include <numeric>

namespace toile {

void NodePlanes::reflect(const std::vector<int>& image) {
  const std::size_t count = planes_.size();
  planes_.reserve(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const Plane& plane = planes_[k];
    add(image[static_cast<std::size_t>(plane.node)], {-plane.normal.x(), plane.normal.y(), plane.normal.z()},
        plane.offset);
  }
}

void NodePlanes::sort(int node_count) {
  begin_.assign(static_cast<std::size_t>(node_count) + 1, 0);
  for (const Plane& plane : planes_) ++begin_[static_cast<std::size_t>(plane.node) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  sorted_.resize(planes_.size());
  for (const Plane& plane : planes_) sorted_[begin_[static_cast<std::size_t>(plane.node)]++] = plane;
  planes_.swap(sorted_);
}

bool NodePlanes::limit(const Points3& from, Points3& to) const {
  bool touched = false;
  for (std::size_t begin = 0, end = 0; begin < planes_.size(); begin = end) {
    const int node = planes_[begin].node;
    while (end < planes_.size() && planes_[end].node == node) ++end;
    to.row(node) = limited({begin, end}, from.row(node), to.row(node), touched).transpose();
  }
  return touched;
}

Vec3 NodePlanes::limited(const Run& run, const Vec3& from, const Vec3& to, bool& touched) const {
  Vec3 p = to;
  for (std::size_t k = run.first; k < run.second; ++k) {
    const double beyond = planes_[k].normal.dot(p) - planes_[k].offset;
    if (beyond >= 0) continue;
    p -= beyond * planes_[k].normal;
    touched = true;
  }
  double share = 1;  // where planes meet, what is left is shortened as a whole
  for (std::size_t k = run.first; k < run.second; ++k) {
    const double ahead = planes_[k].normal.dot(p) - planes_[k].offset;
    if (ahead >= 0) continue;
    const double here = planes_[k].normal.dot(from) - planes_[k].offset;
    share = std::min(share, std::max(0.0, here / std::max(here - ahead, 1e-300)));
  }
  return from + share * (p - from);
}

}  // namespace toile
