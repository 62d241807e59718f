// SPDX-License-Identifier: GPL-3.0-or-later
// What the tables of `toile-bench derive` share: garments and bodies of ../shared/data as inputs of the pipeline.
#pragma once

#include <memory>

#include "engine/pipeline.h"
#include "tests/bench/bench.h"

namespace toile::bench {

struct DeriveRequest {
  std::string what;  // trips, growth, random, sweeps; empty: pairs
  std::vector<std::string> garments, bodies;
  AlterOptions options;
  int count = 100;  // random bodies
  std::string pictures, stages;
};
DeriveRequest derive_request(const std::vector<std::string>& words);

int derive_trips(const DeriveRequest& request, const Arguments& arguments);
int derive_growth(const DeriveRequest& request, const Arguments& arguments);
int derive_random(const DeriveRequest& request, const Arguments& arguments);
int derive_sweeps(const DeriveRequest& request);

// FOLDER/NAME.png: the changed pattern over the original one.
void write_changes(const std::string& folder, const std::string& name, const Pattern& original, const Pattern& changed);

GarmentInput shared_garment(const std::string& name);
BodyInput shared_wearer(const std::string& name);  // a body, or scan_a .. scan_d

// Finished stages in `folder`, or the first `most` of them in memory if that is empty: reference drapes are shared.
std::unique_ptr<StageCache> stage_store(const std::string& folder, std::size_t most = 1000);

// The target pattern of a garment drafted for its own body, for another one.
DerivedGarment derive_pair(const std::string& garment, const std::string& body, const AlterOptions& options,
                           StageCache* stages);

}  // namespace toile::bench
