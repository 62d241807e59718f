// SPDX-License-Identifier: GPL-3.0-or-later
// Drape the altered garment on the target body, its insertions sewn in, and hold its fit against the reference.
//
// The sewn pattern is meshed as any other; every vertex starts where the target pattern's drape has its place in the
// wanted panel. Kept cloth is compared with the same place of the original cloth on the reference body, an insertion
// with the cloth that the target pattern has there.   Source: [Eggler2024, Sec. 8, Fig. 16].  SI units.
#pragma once

#include "engine/alter/sewn_pattern.h"
#include "engine/derive_in_loop.h"

namespace toile {

struct DrapedAlteration {
  std::string problem;  // why there is no drape, or empty
  PatternMesh mesh;     // of the sewn pattern
  DrapeResult drape;
  FittingMap fit;
  FittingMap reference;         // what the fit of each triangle is to be
  PositionDifference position;  // from where the target pattern's drape has the same cloth
};

// `original`: the mesh of the original pattern and its fit on the reference body.
DrapedAlteration drape_altered(const SewnPattern& sewn, const PatternMesh& original, const FittingMap& reference_fit,
                               const DerivedPattern& derived, const Body& target_body, const DrapeOptions& options,
                               Progress* progress = nullptr);

}  // namespace toile
