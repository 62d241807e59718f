// SPDX-License-Identifier: GPL-3.0-or-later
// A drape that goes on from another one's end with friction and the waist's height held as they were there: what
// differs then is due to the mesh or the solver, not to another way to one of the many rest states friction allows.
#pragma once

#include "engine/sim/friction_state.h"
#include "engine/stages/drape.h"

namespace toile {

struct HeldDrape {
  FrictionState friction;    // one row per node
  double hold_height = 0.0;  // see DrapeDiagnostics
};

// As drape(); `end` is overwritten with what holds the result.
DrapeResult drape_to_hold(const Pattern& pattern, const PatternMesh& mesh, const Body& body,
                          const DrapeOptions& options, HeldDrape& end, Progress* progress);

// As drape_from(), with `held` for good. Error{GarmentInvalid} unless it has a row for every node.
DrapeResult drape_held(const Pattern& pattern, const PatternMesh& mesh, const Body& body, const Drape& start,
                       const HeldDrape& held, const DrapeOptions& options, Progress* progress);

}  // namespace toile
