// SPDX-License-Identifier: GPL-3.0-or-later
// Garments of ../shared/data on bodies of it: what the drape's tests and benchmarks dress.
#pragma once

#include <string>

#include "engine/stages/drape.h"
#include "engine/stages/mesh_panels.h"

namespace toile::test {

struct Dressing {
  Pattern pattern;
  PatternMesh mesh;
  Body body;             // with its skeleton
  DrapeOptions options;  // drafted_for set where the body is not the garment's own
};

// `body` empty: the one the garment was drafted for. Call only after TOILE_REQUIRE_SHARED_DATA().
Dressing dress(const std::string& garment, int triangles, const std::string& body = {});

// Mean height of the labelled waist line (0: none) and of the lowest node of a garment of ../shared/data at rest on its
// own body, m: the table of design/sewing.md, section 2. Each was reached to about 6 mm there, and friction makes the
// rest state depend on the way to it by up to 15 mm.
struct Place {
  double waist, lowest;
};
Place expected_place(const std::string& garment);
// Mean height of the edges labelled lower_interface, m; 0 without one.
double waist_height(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape);

}  // namespace toile::test
