// SPDX-License-Identifier: GPL-3.0-or-later
// Carry a drape and the friction that holds it from one mesh of a pattern to another one: every node to where its point
// of the cloth lies. Sewn vertices give the mean of their places in all panels that meet there.
#pragma once

#include "engine/stages/drape_held.h"

namespace toile {

struct DrapeEnd {
  Drape drape;
  HeldDrape held;
};

// Both meshes are of `pattern`. Friction is carried per area: pressure, and how far nodes have slipped from where they
// stick, which is nothing where cloth does not touch.
DrapeEnd carry_drape(const Pattern& pattern, const PatternMesh& from, const DrapeEnd& end, const PatternMesh& to);

}  // namespace toile
