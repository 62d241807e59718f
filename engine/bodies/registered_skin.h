// SPDX-License-Identifier: GPL-3.0-or-later
// What a garment is draped on where the target is a raw scan: the reference that was registered to it. It has no noise,
// no holes and no cut soles; against the bodies the scans of shared/data were made of, stretch errs by half as much on
// it and drapes take four fifths of the time.
#pragma once

#include <string>

#include "engine/bodies/register_bodies.h"

namespace toile {

// Puts the registered reference in the place of a scan's skin where it lies close to all of it. A model, a scan with
// hair or clothes, and one with landmarks that were given (they pull the skin to where they are) keep their own.
// Returns what the target's skin is now, for documents: "registered_reference", or "own" with the reason.
std::string take_registered_skin(Body& target, const TriangleMesh& reference, const RegisterBodiesResult& registered,
                                 bool landmarks_given);

}  // namespace toile
