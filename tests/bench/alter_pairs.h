// SPDX-License-Identifier: GPL-3.0-or-later
// Garments of ../shared/data with the target patterns that the pipeline derives for other bodies: what the alteration's
// benchmark alters. A target pattern is derived once and kept in a folder.
#pragma once

#include <string>
#include <vector>

#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"

namespace toile::bench {

struct AlterPair {
  std::string garment, body;  // names in ../shared/data, the body the one it is altered for
};

// The pairs of the derivation's acceptance: eight garments, five bodies.
std::vector<AlterPair> acceptance_pairs();

struct DerivedPair {
  Pattern pattern;
  PatternMesh mesh;
  Points2 target_rest;  // #V x 2
};

// `cache` empty: derived anew. Throws what the stages throw.
DerivedPair derive_pair(const AlterPair& pair, int triangles, const std::string& cache);

}  // namespace toile::bench
