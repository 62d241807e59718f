// SPDX-License-Identifier: GPL-3.0-or-later
// Heights at which the vertical (z) lines of a lattice cross a closed surface, line by line: which nodes of the lattice
// lie inside.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

class LineCrossings {
 public:
  // Lines through origin + spacing (ix, iy), 0 <= ix < nx and 0 <= iy < ny.
  LineCrossings(const Points3& vertices, const Triangles& triangles, const Vec2& origin, double spacing, int nx,
                int ny);

  // Winding number of the surface round the point of a line at the height z.
  int winding(int ix, int iy, double z) const;

 private:
  struct Crossing {
    double z;
    int change;  // of the winding number on passing upwards in z
  };

  void rasterise(const Vec3& a, const Vec3& b, const Vec3& c, int pass);
  std::size_t line(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
  }

  Vec2 origin_;
  double spacing_;
  int nx_, ny_;
  std::vector<int> begin_;
  std::vector<Crossing> crossings_;
};

}  // namespace toile
