// SPDX-License-Identifier: GPL-3.0-or-later
// Horizontal slices of a triangle surface, in components. Closed or not: a hole only opens the outline.
#pragma once

#include <span>

#include "engine/core/body.h"

namespace toile {

// One connected piece of a slice: segments in the plane (x, z), in no particular order.
struct SliceComponent {
  std::vector<std::array<Vec2, 2>> segments;
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);  // its box

  Vec2 centre() const { return 0.5 * (low + high); }
  void add(const SliceComponent& other);
  double hull_girth() const;  // perimeter of the convex hull, m
  // Segments' end points with x in [x_low, x_high]; segments that cross a bound contribute the crossing point.
  std::vector<Vec2> points(double x_low = -1e300, double x_high = 1e300) const;
};

// Keeps the triangles sorted by height so that a slice only looks at those near its level. O(#F) once, O(segments) a
// slice.
class MeshSlicer {
 public:
  explicit MeshSlicer(const TriangleMesh& mesh);

  // Components of the slice at height y, joined where segments share a mesh edge, largest box first. Components whose
  // boxes come within `merge_within` of each other are then joined too, so that an outline broken by holes stays one.
  std::vector<SliceComponent> slice(double y, double merge_within = -1.0) const;

  double bottom() const { return bottom_; }
  double top() const { return top_; }

 private:
  std::span<const int> triangles_near(double y) const;

  const TriangleMesh& mesh_;
  double bottom_ = 0.0, top_ = 0.0, bin_height_ = 1.0;
  std::vector<int> bin_begin_, bin_triangles_;
};

}  // namespace toile
