// SPDX-License-Identifier: GPL-3.0-or-later
// A coarser surface of the same shape.
#pragma once

#include "engine/core/body.h"

namespace toile {

// Collapses edges, cheapest first by the quadric error, until `vertices` are left (more where collapses would fold the
// surface or change its topology). Each vertex also weakly holds its place, which keeps flat parts evenly meshed.
// The same input gives the same output. Source: Garland, Heckbert, SIGGRAPH 1997.
TriangleMesh decimate(const TriangleMesh& mesh, int vertices);

}  // namespace toile
