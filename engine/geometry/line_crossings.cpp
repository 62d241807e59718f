// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/line_crossings.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/closest_point.h"

namespace toile {

LineCrossings::LineCrossings(const Points3& vertices, const Triangles& triangles, const Vec2& origin, double spacing,
                             int nx, int ny)
    : origin_(origin), spacing_(spacing), nx_(nx), ny_(ny), begin_(static_cast<std::size_t>(nx) * ny + 1, 0) {
  for (int pass = 0; pass < 2; ++pass) {
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
      rasterise(vertices.row(triangles(f, 0)), vertices.row(triangles(f, 1)), vertices.row(triangles(f, 2)), pass);
    if (pass == 0) {
      for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
      crossings_.resize(static_cast<std::size_t>(begin_.back()));
    }
  }
  // The second pass counted every line's start down to where the line begins.
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
    std::sort(crossings_.begin() + begin_[i], crossings_.begin() + begin_[i + 1],
              [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
}

int LineCrossings::winding(int ix, int iy, double z) const {
  int winding = 0;
  for (int k = begin_[line(ix, iy)]; k < begin_[line(ix, iy) + 1] && crossings_[static_cast<std::size_t>(k)].z < z; ++k)
    winding += crossings_[static_cast<std::size_t>(k)].change;
  return winding;
}

void LineCrossings::rasterise(const Vec3& a, const Vec3& b, const Vec3& c, int pass) {
  const auto index = [&](double v, int axis) { return (v - origin_[axis]) / spacing_; };
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  // Widened by a little: which triangle owns a line is for line_crossing alone to say, not for rounding here.
  const auto first = [&](double v, int axis) {
    return std::max(0, static_cast<int>(std::ceil(index(v, axis) - 1e-6)));
  };
  const auto last = [&](double v, int axis, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(index(v, axis) + 1e-6)));
  };
  const int x0 = first(low.x(), 0), x1 = last(high.x(), 0, nx_), y0 = first(low.y(), 1), y1 = last(high.y(), 1, ny_);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      const Vec2 at = origin_ + spacing_ * Vec2(ix, iy);
      double z = 0;
      const int side = line_crossing(at, a, b, c, z);
      if (side == 0) continue;
      if (pass == 0)
        ++begin_[line(ix, iy)];
      else
        crossings_[static_cast<std::size_t>(--begin_[line(ix, iy)])] = {z, -side};
    }
}

}  // namespace toile
