// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies drawn from seeds: blends and scalings of the shared family. The same number gives the same body everywhere.
#pragma once

#include <vector>

#include "engine/pipeline_inputs.h"

namespace toile::bench {

// The bodies that are blended. Throws Error{NotFound} without ../shared/data.
std::vector<TriangleMesh> shared_family();

// Two bodies of the family mixed, and scaled: 1.45 to 2 m tall, by a tenth wider or narrower than tall.
BodyInput random_body(int number, const std::vector<TriangleMesh>& family);

}  // namespace toile::bench
