// SPDX-License-Identifier: GPL-3.0-or-later
// A whole job, run as a worker runs it, with the clocks and the peak memory of every stage.
#pragma once

#include <memory>

#include "engine/outputs.h"
#include "tests/support/scenes.h"

namespace toile::bench {

struct StageCost {
  std::string stage;
  double cpu_s = 0.0, wall_s = 0.0, peak_mb = 0.0;  // memory: of the whole process while the stage ran
  bool reused = false;
};

struct JobRun {
  AlterResult result;
  std::vector<OutputFile> files;
  std::vector<StageCost> stages;  // in the order they ran, the making of files last
  double cpu_s = 0.0, wall_s = 0.0, peak_mb = 0.0;
};

// Throws what the stages throw.
JobRun run_job(const test::Scene& scene, const AlterOptions& options, StageCache* cache = nullptr, int threads = 1);

// What `--outputs` means to benchmarks: "none" (result.json alone), "images" (the four of the fit), "all".
std::vector<std::string> outputs_named(const std::string& choice);
Preset preset_named(const std::string& name);

}  // namespace toile::bench
