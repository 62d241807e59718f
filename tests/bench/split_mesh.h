// SPDX-License-Identifier: GPL-3.0-or-later
// Every triangle of a garment's mesh cut into four at the middles of its edges, sewn as before: the same cloth with
// half the edge length, so that what differs between drapes of both is the error of the coarser mesh.
#pragma once

#include "engine/core/pattern_mesh.h"

namespace toile::bench {

PatternMesh split_mesh(const PatternMesh& coarse);

}  // namespace toile::bench
