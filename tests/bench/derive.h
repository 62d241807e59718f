// SPDX-License-Identifier: GPL-3.0-or-later
// What the tables of `toile-bench derive` share: garments and bodies of ../shared/data as inputs of the pipeline.
#pragma once

#include <memory>

#include "engine/pipeline.h"
#include "tests/bench/bench.h"

namespace toile::bench {

GarmentInput shared_garment(const std::string& name);
BodyInput shared_wearer(const std::string& name);  // a body, or scan_a .. scan_d

// Finished stages in memory, and in `folder` too unless that is empty: reference drapes are shared between pairs.
std::unique_ptr<StageCache> stage_store(const std::string& folder);

// The target pattern of a garment drafted for its own body, for another one.
DerivedGarment derive_pair(const std::string& garment, const std::string& body, const AlterOptions& options,
                           StageCache* stages);

// Whether the drawn outline of a panel crosses or touches itself.
bool crosses_itself(const Panel& panel);

}  // namespace toile::bench
