// SPDX-License-Identifier: GPL-3.0-or-later
// A garment on a body, at rest or as near as the solver came.
#pragma once

#include "engine/core/types.h"

namespace toile {

struct Drape {
  Points3 nodes;  // #N x 3, garment nodes in the body's normalised frame, m
};

}  // namespace toile
