// SPDX-License-Identifier: GPL-3.0-or-later
// From a sewn garment round a body to its rest there: quasi-Newton, firmer contact where it presses too deep, then
// Newton where asked for; or the paper's averaging. Used by drape only. Source: design/sewing.md F. SI units.
#pragma once

#include "engine/sim/drape_energy.h"
#include "engine/stages/drape_held.h"

namespace toile {

struct GarmentOnBody {
  const PatternMesh& mesh;
  const Cloth& cloth;
  SurfaceField& field;
  double thickness = 0.0;  // distance kept from the body, chord sag included, m
  std::vector<Hold> holds;
  std::vector<Pin> pins;
  const NodeMirror* mirror = nullptr;       // not null: sought among symmetric drapes
  const HalfCloth* half = nullptr;          // not null: by moving this half alone, with `mirror`
  std::vector<std::vector<int>> watched;    // lines of nodes that tell whether it still moves
  bool worn = false;                        // it was at rest before
  const FrictionState* friction = nullptr;  // not null: of the start
  bool hold_friction = false;               // that of the start for good, instead of frozen anew in rounds
};

// Overwrites the nodes and what the solver knows of diagnostics and quality. Returns friction as it is at the end.
FrictionState come_to_rest(const GarmentOnBody& garment, const Points3& start, const DrapeOptions& options,
                           DrapeResult& result, Progress* progress);

}  // namespace toile
