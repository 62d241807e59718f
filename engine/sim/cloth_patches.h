// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a garment may be near each other although the cloth between them is long: the broad phase of
// self-contact. Triangles lie in small patches of one panel with a box and a cone of normals each; two patches that
// are the same or hang together and are as good as flat cannot touch [Volino1994]. SI units.
#pragma once

#include "engine/core/types.h"

namespace toile {

struct TriangleBox {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  // Closer than `reach` in every coordinate.
  bool near(const TriangleBox& other, double reach) const {
    return ((low - other.high).array() <= reach).all() && ((other.low - high).array() <= reach).all();
  }
};

class ClothPatches {
 public:
  // `triangles`: nodes of every triangle, none with two equal ones; `rest`: one point per triangle, in its panel's
  // plane; `panel`: of every triangle, ascending.
  ClothPatches(const Triangles& triangles, const Points2& rest, const std::vector<int>& panel);

  // Pairs of triangles whose boxes are closer than `reach`, each once, but for those that lie in smooth cloth
  // together. The order is always the same.
  const std::vector<std::pair<int, int>>& find_near(const Points3& nodes, double reach);

 private:
  struct Patch {
    int begin, end;  // of order_
    TriangleBox box;
    Vec3 axis;
    double spread;  // largest angle of a normal from the axis, rad
    int panel;      // in the order of `triangles`
  };

  void divide(const Points2& rest, int begin, int end, int panel);
  void find_sides(const std::vector<int>& panel);
  void find_neighbours();
  void measure(const Points3& nodes);
  bool smooth(const Patch& a, const Patch& b) const;
  // Patches that come within `reach`, same and neighbouring ones only where not smooth, ascending.
  void find_pairs(double reach);

  const Triangles triangles_;
  std::vector<int> order_;  // triangles, patch by patch
  std::vector<Patch> patches_;
  std::vector<double> side_;                       // per panel: 1, or -1 where its triangles face the other way
  std::vector<std::pair<int, int>> twisted_;       // panels, ascending, sewn so that no side suits them both
  std::vector<std::vector<int>> neighbours_;       // per patch, ascending: patches with a common node
  std::vector<TriangleBox> boxes_;                 // per triangle
  std::vector<std::pair<int, int>> pairs_, near_;  // of patches, of triangles
  std::vector<int> by_height_, near_a_, near_b_;
};

}  // namespace toile
