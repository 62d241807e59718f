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

void NodePlanes::sort(const Points3& nodes) {
  begin_.assign(static_cast<std::size_t>(nodes.rows()) + 1, 0);
  for (const Plane& plane : planes_) ++begin_[static_cast<std::size_t>(plane.node) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  sorted_.resize(planes_.size());
  for (const Plane& plane : planes_) sorted_[begin_[static_cast<std::size_t>(plane.node)]++] = plane;
  planes_.swap(sorted_);
  runs_.clear();
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const Plane& plane = planes_[k];
    const double ahead = plane.normal.dot(nodes.row(plane.node)) - plane.offset;
    if (runs_.empty() || runs_.back().node != plane.node) runs_.push_back({k, k, plane.node, ahead});
    runs_.back().end = k + 1;
    runs_.back().clear = std::min(runs_.back().clear, ahead);
  }
}

bool NodePlanes::limit(const Points3& from, Points3& to, double moved) const {
  bool touched = false;
  for (const Run& run : runs_)
    if (run.clear <= moved) to.row(run.node) = limited(run, from.row(run.node), to.row(run.node), touched).transpose();
  return touched;
}

Vec3 NodePlanes::limited(const Run& run, const Vec3& from, const Vec3& to, bool& touched) const {
  Vec3 p = to;
  bool stopped = false;
  for (std::size_t k = run.begin; k < run.end; ++k) {
    const double beyond = planes_[k].normal.dot(p) - planes_[k].offset;
    if (beyond >= 0) continue;
    p -= beyond * planes_[k].normal;
    stopped = true;
  }
  if (!stopped) return to;
  touched = true;
  double share = 1;  // where planes meet, what is left is shortened as a whole
  for (std::size_t k = run.begin; k < run.end; ++k) {
    const double ahead = planes_[k].normal.dot(p) - planes_[k].offset;
    if (ahead >= 0) continue;
    const double here = planes_[k].normal.dot(from) - planes_[k].offset;
    share = std::min(share, std::max(0.0, here / std::max(here - ahead, 1e-300)));
  }
  return from + share * (p - from);
}

}  // namespace toile
