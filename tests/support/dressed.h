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

}  // namespace toile::test
