// SPDX-License-Identifier: GPL-3.0-or-later
// The tube skirt of the examples as a job, small enough for many of them.
#pragma once

#include <string>

#include "engine/pipeline.h"
#include "tests/support/shared_data.h"

namespace toile::test {

inline GarmentInput tube_skirt() {
  return {"tube_skirt.json", read_file(std::string(TOILE_SOURCE_DIR) + "/schemas/examples/tube_skirt.json")};
}

inline AlterOptions small_job() {
  AlterOptions options;
  options.triangles = 1000;
  return options;
}

}  // namespace toile::test
