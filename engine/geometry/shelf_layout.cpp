// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/shelf_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace toile {

ShelfLayout lay_on_shelves(const std::vector<Vec2>& sizes, double width, double gap) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return sizes[a].y() > sizes[b].y(); });
  ShelfLayout layout;
  layout.corners.resize(sizes.size(), Vec2::Zero());
  double x = 0.0, top = 0.0, shelf_height = 0.0;
  for (const std::size_t i : order) {
    if (x > 0 && x + sizes[i].x() > width) top += shelf_height + gap, x = 0.0;
    if (x == 0) shelf_height = sizes[i].y();
    layout.corners[i] = Vec2(x, -top - sizes[i].y());
    x += sizes[i].x() + gap;
    layout.size = layout.size.cwiseMax(Vec2(x - gap, top + sizes[i].y()));
  }
  for (Vec2& corner : layout.corners) corner.y() += layout.size.y();
  return layout;
}

double shelf_width(const std::vector<Vec2>& sizes, double gap, double aspect) {
  double area = 0.0, widest = 0.0;
  for (const Vec2& size : sizes) area += (size.x() + gap) * (size.y() + gap), widest = std::max(widest, size.x());
  return std::max(widest, std::sqrt(area * aspect));
}

}  // namespace toile
