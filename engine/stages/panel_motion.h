// SPDX-License-Identifier: GPL-3.0-or-later
// How one panel moves as a pattern is derived: its flat triangles before and after.  Metres.
#pragma once

#include "engine/core/pattern_mesh.h"

namespace toile {

class PanelMotion {
 public:
  // Both must outlive it. `target` is #V x 2.
  PanelMotion(const PatternMesh& mesh, const Points2& target, int panel);

  Mat2 at_vertex(int v) const;                          // mean deformation round a vertex, weighted by area
  Mat2 around(const Vec2& point, double radius) const;  // the same over the triangles about a point
  Vec2 moved(const Vec2& point) const;                  // where a point of the panel goes
  Mat2 turn_at(const Vec2& point) const;                // how its surroundings turn, without stretch

 private:
  Vec2 rest(int v) const { return mesh_.rest.row(v); }
  Mat2 edges(const Points2& points, int f) const;
  double area_of(int f) const;
  const Mat2& gradient(int f) const { return gradients_[static_cast<std::size_t>(f - range_.triangle_begin)]; }
  int triangle_at(const Vec2& point) const;  // that holds the point, or that it is least outside of

  const PatternMesh& mesh_;
  const Points2& target_;
  PanelRange range_;
  std::vector<Mat2> gradients_;
};

}  // namespace toile
