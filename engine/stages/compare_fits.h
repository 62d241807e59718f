// SPDX-License-Identifier: GPL-3.0-or-later
// How far one fit is from another, triangle by triangle and node by node.
//
// Stretch error of a triangle: the root mean square of its differences in weft and warp stretch. Every mean is weighted
// by the rest area of the reference fit; triangles degenerate in either map are left out and counted.
#pragma once

#include "engine/bodies/body_zones.h"
#include "engine/core/fitting_map.h"
#include "engine/core/pattern_mesh.h"

namespace toile {

struct FitDifference {
  double rms_weft = 0.0, rms_warp = 0.0;    // dimensionless
  double rms_stretch = 0.0;                 // both directions together: sqrt((weft^2 + warp^2) / 2)
  double rms_shear = 0.0;                   // rad
  double mean_weft = 0.0, mean_warp = 0.0;  // signed, fit minus reference: > 0 is tighter than the reference
  double share_beyond = 0.0;                // share of the area where weft or warp differs by more than `limit`
  double area = 0.0;                        // compared, m^2
};

struct FitComparison {
  FitDifference whole;
  std::vector<FitDifference> panels;  // one per panel of the mesh
  std::vector<FitDifference> zones;   // one per BodyZone, without area where the garment covers nothing
  int degenerate_triangles = 0;
  int worst_triangle = -1;  // of the largest difference in weft or warp
  double worst_difference = 0.0;
};

struct CompareFitsOptions {
  double limit = 0.03;  // dimensionless, > 0: differences beyond it count in share_beyond
};

// Requires both maps to be of `mesh`'s triangles. `zones`: the body zone of every triangle (body_zones), or empty.
FitComparison compare_fits(const PatternMesh& mesh, const FittingMap& reference, const FittingMap& fit,
                           const CompareFitsOptions& options = {}, const std::vector<BodyZone>& zones = {});

struct PositionDifference {
  double rms = 0.0, p95 = 0.0, largest = 0.0;  // m, distance between equal garment nodes
  int worst_node = -1;
};

// Requires equal numbers of rows (#N x 3, m). Each node counts once.
PositionDifference compare_positions(const Points3& wanted, const Points3& reached);

}  // namespace toile
