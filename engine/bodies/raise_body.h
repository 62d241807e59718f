// SPDX-License-Identifier: GPL-3.0-or-later
// Move a body up or down in the normalised frame, with all that is known of it.
#pragma once

#include "engine/core/body.h"

namespace toile {

// `by` metres, up positive: surface, skeleton, landmarks, the way from the file, and the measurements that are heights
// over the floor.
void raise_body(Body& body, double by);

}  // namespace toile
