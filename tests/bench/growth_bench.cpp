// SPDX-License-Identifier: GPL-3.0-or-later
// growth [SCENE] [--sizes N,N,...]: a whole job without pictures over meshes of 2,500 triangles and more:
// CPU seconds of every stage, the exponent of their growth, and the peak memory of each size.
#include <cstdio>
#include <cstdlib>
#include <map>

#include "tests/bench/plot.h"
#include "tests/bench/proof.h"
#include "tests/bench/whole_job.h"
#include "tests/bench/words.h"

namespace toile::bench {
namespace {

struct GrowthRequest {
  std::string scene = "leggings_tight";
  std::vector<int> sizes = {2500, 5000, 10000, 20000};
};

GrowthRequest growth_request(Words words) {
  GrowthRequest request;
  if (const auto sizes = words.list("--sizes")) {
    request.sizes.clear();
    for (const std::string& size : *sizes) request.sizes.push_back(std::atoi(size.c_str()));
  }
  if (!words.rest().empty()) request.scene = words.rest().back();
  return request;
}

}  // namespace

int bench_growth(const Arguments& arguments) {
  const GrowthRequest request = growth_request(Words(arguments.words));
  const test::Scene scene = test::named_scene(request.scene);
  AlterOptions options;
  options.outputs = outputs_named("none");
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> times;
  std::vector<double> sizes, memory;
  for (const int triangles : request.sizes) {
    options.triangles = triangles;
    const JobRun run = run_job(scene, options);
    sizes.push_back(run.result.reference.mesh.triangle_count());
    memory.push_back(run.peak_mb);
    std::map<std::string, double> sums;
    for (const StageCost& stage : run.stages) {
      if (!times.contains(stage.stage)) times[stage.stage], order.push_back(stage.stage);
      sums[stage.stage] += stage.cpu_s;
    }
    for (const auto& [stage, sum] : sums) times[stage].push_back(sum);
    times["all"].push_back(run.cpu_s);
    std::printf("%s: %.0f triangles, %.1f CPU s, %.0f MB\n", scene.name.c_str(), sizes.back(), run.cpu_s, run.peak_mb);
    std::fflush(stdout);
  }
  order.push_back("all");
  std::vector<std::string> columns = {"stage"};
  for (const double size : sizes) columns.push_back(fixed(size, 0));
  columns.push_back("grows as n^");
  Table table(columns);
  Plot plot{"Growth of a whole job: " + scene.name, "triangles", "CPU s", true, true, {}};
  for (const std::string& stage : order) {
    std::vector<std::string> row = {stage};
    for (const double time : times[stage]) row.push_back(fixed(time, 3));
    row.push_back(times[stage].back() > 0.01 && sizes.size() > 1 ? fixed(growth_exponent(sizes, times[stage]), 2)
                                                                 : "-");
    table.add(row);
    if (times[stage].back() > 0.01) plot.curves.push_back({stage, sizes, times[stage], {}, true});
  }
  std::vector<std::string> row = {"peak MB"};
  for (const double peak : memory) row.push_back(fixed(peak, 0));
  row.push_back("-");
  table.add(row);
  table.print(arguments.csv);
  if (!arguments.svg.empty()) write_plot(plot, arguments.svg);
  return 0;
}

}  // namespace toile::bench
