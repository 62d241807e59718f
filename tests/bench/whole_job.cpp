// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/whole_job.h"

#include "engine/core/error.h"
#include "tests/bench/bench.h"

namespace toile::bench {
namespace {

// Peak memory of every stage, told apart by the names it is reported under.
class MemoryByStage {
 public:
  MemoryByStage() {
    progress_.report = [this](std::string_view stage, double) {
      if (!stages_.empty() && stages_.back() == stage) return;
      end_stage();
      stages_.emplace_back(stage);
    };
    forget_peak_memory();
  }
  void end_stage() {
    if (!stages_.empty()) peaks_.push_back(peak_memory_mb());
    forget_peak_memory();
  }
  const Progress* progress() const { return &progress_; }
  // Of the `i`-th timing; skipped stages were reported but not timed.
  double peak(const std::string& stage, std::size_t& from) const {
    while (from < peaks_.size() && stages_[from] != stage) ++from;
    return from < peaks_.size() ? peaks_[from++] : 0.0;
  }

 private:
  Progress progress_;
  std::vector<std::string> stages_;
  std::vector<double> peaks_;
};

}  // namespace

JobRun run_job(const test::Scene& scene, const AlterOptions& options, StageCache* cache, int threads) {
  JobRun run;
  const double cpu = cpu_seconds(), wall = wall_seconds();
  MemoryByStage memory;
  StageRunner runner(cache, memory.progress(), kAlterStages, threads);
  run.result = alter_garment(scene.garment, scene.reference, scene.target, options, runner);
  memory.end_stage();
  const double files_cpu = cpu_seconds(), files_wall = wall_seconds();
  run.files =
      alter_outputs(run.result, options, job_info(scene.garment, scene.reference, scene.target), runner.at_once());
  std::size_t from = 0;
  for (const StageTiming& timing : runner.timings())
    run.stages.push_back({timing.stage, timing.cpu_s, timing.wall_s, memory.peak(timing.stage, from), timing.reused});
  run.stages.push_back({"outputs", cpu_seconds() - files_cpu, wall_seconds() - files_wall, peak_memory_mb(), false});
  run.cpu_s = cpu_seconds() - cpu;
  run.wall_s = wall_seconds() - wall;
  for (const StageCost& stage : run.stages) run.peak_mb = std::max(run.peak_mb, stage.peak_mb);
  return run;
}

std::vector<std::string> outputs_named(const std::string& choice) {
  if (choice == "none") return {"result.json"};
  if (choice == "images") return {"fit_reference.png", "fit_before.png", "fit_target.png", "fit_after.png"};
  if (choice == "all") return {"all"};
  throw Error(ErrorCode::OptionInvalid, "outputs", "--outputs must be none, images or all");
}

Preset preset_named(const std::string& name) {
  if (name == "draft") return Preset::Draft;
  if (name == "standard") return Preset::Standard;
  if (name == "fine") return Preset::Fine;
  throw Error(ErrorCode::OptionInvalid, "preset", "--preset must be draft, standard or fine");
}

}  // namespace toile::bench
