// SPDX-License-Identifier: GPL-3.0-or-later
// A body made exactly symmetric, to tell the asymmetry of a computation from that of its input.
#pragma once

#include "engine/core/body.h"

namespace toile::test {

// The half of a closed surface on the side x > 0, cut along x = 0, and its mirror image: closed again.
TriangleMesh mirrored_half(const TriangleMesh& surface);

}  // namespace toile::test
