// SPDX-License-Identifier: GPL-3.0-or-later
// How each triangle of cloth is deformed when worn [Eggler2024, Sec. 4].
#pragma once

#include "engine/core/types.h"

namespace toile {

struct FittingMap {
  std::vector<Mat2> tensor;      // #F, rest frame -> tangent frame of the drape, [[|Fu|, |Fv| sin s], [0, |Fv| cos s]]
  Eigen::VectorXd stretch_weft;  // #F, |Fu| - 1 recovered from neighbours, dimensionless, > 0 is tension
  Eigen::VectorXd stretch_warp;  // #F, |Fv| - 1, recovered too
  Eigen::VectorXd shear;         // #F, asin(Fu.Fv / |Fu||Fv|), recovered too, rad
  Eigen::VectorXd rest_area;     // #F, m^2
  std::vector<bool> degenerate;  // #F, the drape has no usable tangent frame there; tensor from the polar frame

  int triangle_count() const { return static_cast<int>(tensor.size()); }

  // The signed stretch of larger magnitude, weft or warp: what the pictures show.
  double signed_stretch(int f) const {
    return std::abs(stretch_weft[f]) >= std::abs(stretch_warp[f]) ? stretch_weft[f] : stretch_warp[f];
  }
};

}  // namespace toile
