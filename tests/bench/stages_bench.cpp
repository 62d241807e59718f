// SPDX-License-Identifier: GPL-3.0-or-later
// stages [SCENE...] [--triangles N] [--outputs none|images|all] [--preset draft|standard|fine] [--threads N]
// A whole job, cold: CPU and wall seconds of every stage (median, least and most of the repeats) and the peak memory
// while it ran, beside the budget for 10,000 triangles.
#include <algorithm>
#include <cstdio>
#include <map>

#include "engine/core/error.h"
#include "tests/bench/bench.h"
#include "tests/bench/plot.h"
#include "tests/bench/whole_job.h"
#include "tests/bench/words.h"

namespace toile::bench {
namespace {

struct StagesRequest {
  std::vector<std::string> scenes;
  AlterOptions options;
  int threads = 1;  // of the job
};

StagesRequest stages_request(Words words) {
  StagesRequest request;
  request.options.outputs = outputs_named(words.text("--outputs").value_or("images"));
  if (const auto triangles = words.integer("--triangles")) request.options.triangles = *triangles;
  if (const auto preset = words.text("--preset")) request.options.preset = preset_named(*preset);
  request.threads = words.integer("--threads").value_or(request.threads);
  request.scenes = words.rest();
  if (request.scenes.empty()) request.scenes = {"leggings_tight"};
  return request;
}

// Goal and gate of the design's budget, CPU seconds.
const std::map<std::string, std::pair<double, double>>& budget() {
  static const std::map<std::string, std::pair<double, double>> table = {
      {"import_body", {0.2, 0.75}},  {"import_target_body", {0.2, 0.75}}, {"register_bodies", {1.0, 2.5}},
      {"drape", {1.6, 4.0}},         {"drape_before", {0.8, 2.0}},        {"derive_pattern", {1.0, 3.0}},
      {"alter_pattern", {0.6, 1.5}}, {"drape_altered", {0.5, 2.0}},       {"outputs", {0.8, 2.0}},
      {"all", {6.0, 18.0}}};
  return table;
}

struct Samples {
  std::vector<double> cpu, wall, memory;
};

void add_row(Table& table, Bars& bars, const std::string& scene, const std::string& stage, const Samples& samples) {
  const auto [least, most] = std::minmax_element(samples.cpu.begin(), samples.cpu.end());
  const auto goal = budget().find(stage);
  const bool known = goal != budget().end();
  table.add({scene, stage, fixed(median(samples.cpu), 3), fixed(*least, 3), fixed(*most, 3),
             fixed(median(samples.wall), 3), fixed(median(samples.memory), 0),
             known ? fixed(goal->second.first, 1) : "-", known ? fixed(goal->second.second, 1) : "-"});
  bars.names.push_back(scene + " " + stage);
  bars.values.push_back(median(samples.cpu));
  bars.low.push_back(*least);
  bars.high.push_back(*most);
}

void run_scene(const StagesRequest& request, const std::string& name, int repeats, Table& table, Bars& bars) {
  const test::Scene scene = test::named_scene(name);
  std::vector<std::string> order;
  std::map<std::string, Samples> stages;
  Samples all;
  int triangles = 0;
  for (int i = 0; i < repeats; ++i) {
    const JobRun run = run_job(scene, request.options, nullptr, request.threads);
    triangles = run.result.reference.mesh.triangle_count();
    std::map<std::string, int> seen;
    for (const StageCost& cost : run.stages) {
      const std::string stage = seen[cost.stage]++ ? cost.stage + " (target)" : cost.stage;
      if (!stages.contains(stage)) order.push_back(stage);
      Samples& samples = stages[stage];
      samples.cpu.push_back(cost.cpu_s), samples.wall.push_back(cost.wall_s), samples.memory.push_back(cost.peak_mb);
    }
    all.cpu.push_back(run.cpu_s), all.wall.push_back(run.wall_s), all.memory.push_back(run.peak_mb);
  }
  for (const std::string& stage : order) add_row(table, bars, name, stage, stages[stage]);
  add_row(table, bars, name, "all", all);
  std::printf("%s: %d triangles, %d runs\n", name.c_str(), triangles, repeats);
}

}  // namespace

int bench_stages(const Arguments& arguments) {
  const StagesRequest request = stages_request(Words(arguments.words));
  Table table({"scene", "stage", "CPU s", "least", "most", "wall s", "peak MB", "goal", "gate"});
  Bars bars{"CPU seconds of every stage of a job", "CPU s, median; line: least to most", {}, {}, {}, {}};
  for (const std::string& scene : request.scenes) run_scene(request, scene, arguments.repeats, table, bars);
  table.print(arguments.csv);
  if (!arguments.svg.empty()) write_bars(bars, arguments.svg);
  return 0;
}

}  // namespace toile::bench
