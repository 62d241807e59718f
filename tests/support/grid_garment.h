// SPDX-License-Identifier: GPL-3.0-or-later
// Garments of rectangular panels meshed as grids: small, exact and made in code.
#pragma once

#include <functional>

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile::test {

struct GridPanel {
  std::string name;
  double width = 0.4, height = 0.6;  // m; corners (0,0) (w,0) (w,h) (0,h): edges 0 bottom, 1 right, 2 top, 3 left
  int columns = 20, rows = 30;       // cells
  double jitter = 0.0;               // of the inner vertices, in cells, below 0.3: makes the grid irregular
};

struct GridSeam {
  int panel_a, edge_a, panel_b, edge_b;
};

struct GridGarment {
  Pattern pattern;
  PatternMesh mesh;

  // The mesh's flat positions carried by a map of each panel's plane.
  Points2 mapped(const std::function<Vec2(int panel, const Vec2&)>& map) const;
};

// Requires sewn edges to have equal numbers of cells.
GridGarment grid_garment(const std::vector<GridPanel>& panels, const std::vector<GridSeam>& seams = {});

}  // namespace toile::test
