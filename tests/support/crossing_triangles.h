// SPDX-License-Identifier: GPL-3.0-or-later
// Do triangles of a surface run through each other?
#pragma once

#include <utility>
#include <vector>

#include "engine/core/body.h"

namespace toile::test {

// Pairs of triangles of which an edge of one passes through the other. Neighbours by an edge are left out; of
// neighbours by one vertex the opposite edges are tested. Double arithmetic: touching within rounding may count either
// way.
std::vector<std::pair<int, int>> crossing_triangles(const TriangleMesh& mesh);

}  // namespace toile::test
