// SPDX-License-Identifier: GPL-3.0-or-later
// Fill a polygon with well-shaped triangles of one size, keeping its boundary points as they are.
//
// Interior points start on a hexagonal lattice (rows along x), at least 0.6 edge lengths from the boundary; then rounds
// of Laplacian smoothing and constrained Delaunay triangulation. Source: design notes on meshing panels.
#pragma once

#include <vector>

#include "engine/core/types.h"

namespace toile {

struct PolygonMesh {
  std::vector<Vec2> points;  // the polygon's points first, in their order, then the interior ones
  Triangles triangles;       // counter-clockwise
};

// Requires: `polygon` counter-clockwise and free of self-crossings, `edge_length` > 0. Deterministic.
// Throws Error{GarmentInvalid} when the polygon crosses itself.
PolygonMesh mesh_polygon(const std::vector<Vec2>& polygon, double edge_length);

}  // namespace toile
