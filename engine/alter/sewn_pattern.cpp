// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sewn_pattern.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/curve.h"

namespace toile {

double seam_mismatch(const SewnPattern& sewn) {
  const auto length = [&](const SeamSide& side) { return edge_length(sewn.pattern.panel(side.panel), side.edge); };
  double most = 0.0;
  for (std::size_t s = 0; s < sewn.seams.size(); ++s) {
    const Seam& seam = sewn.pattern.seams[s];
    most = std::max(most, std::abs(length(seam.a) - length(seam.b) - sewn.seams[s].eased));
  }
  return most;
}

}  // namespace toile
