// SPDX-License-Identifier: GPL-3.0-or-later
// Drape the altered garment on the target body, its insertions sewn in, and hold its fit against the reference.
//
// The sewn pattern is meshed as any other; every vertex starts where a drape of the target pattern has its place in the
// wanted panel. Where the alteration was tried on with the same mesh, that is the drape. Kept cloth is compared with
// the same place of the original cloth on the reference body, an insertion with the cloth that the target pattern has
// there.   Source: [Eggler2024, Sec. 8, Fig. 16].  SI units.
#pragma once

#include "engine/alter/sewn_pattern.h"
#include "engine/stages/compare_fits.h"
#include "engine/stages/drape_series.h"

namespace toile {

// How a sewn pattern came to rest.
struct TriedOn {
  std::string problem;  // why there is no drape, or empty
  PatternMesh mesh;     // of the sewn pattern
  DrapeResult drape;
  PositionDifference position;  // from where it started
};

struct DrapedAlteration {
  std::string problem;  // why there is no drape, or empty
  PatternMesh mesh;     // of the sewn pattern
  DrapeResult drape;
  FittingMap fit;
  FittingMap reference;         // what the fit of each triangle is to be
  PositionDifference position;  // from the scene's drape of the target pattern
};

// What altered garments are held against.
struct AlterationScene {
  const PatternMesh& original;  // of the original pattern
  const FittingMap& reference_fit;
  const PatternMesh& target;  // of the target pattern
  const Drape& start;         // of the target pattern on the target body
};

// A pattern as if it were an alteration that cuts nothing: every panel one piece. `mesh`: of that pattern.
SewnPattern uncut(const Pattern& pattern, const PatternMesh& mesh);

// `edge_length`: of the mesh, m. `on_target`: on the target body.
TriedOn try_on(const AlterationScene& scene, const SewnPattern& sewn, double edge_length, DrapeSeries& on_target,
               const DrapeOptions& options, Progress* progress = nullptr);

// On a mesh as fine as the original's. `worn`: how the same was tried on with such a mesh and the same options, or {}.
DrapedAlteration drape_altered(const AlterationScene& scene, const SewnPattern& sewn, TriedOn worn,
                               DrapeSeries& on_target, const DrapeOptions& options, Progress* progress = nullptr);

}  // namespace toile
