// SPDX-License-Identifier: GPL-3.0-or-later
// examples [GARMENT...] [--triangles N] [--sentences]: every drafted example draped on the mannequin it was drafted for
// and altered for the others of five; rest, what lies inside the body, fit before and after, flips, and what is sewn.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "engine/pipeline.h"
#include "tests/bench/bench.h"
#include "tests/support/shared_data.h"
#include "tests/support/shipped_examples.h"

namespace toile::bench {
namespace {

struct Request {
  std::vector<std::string> garments;
  AlterOptions options;
  bool sentences = false;
};

Request parse(const std::vector<std::string>& words) {
  Request request;
  request.options.triangles = 4000;
  request.options.outputs = {"ticket.json"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--triangles" && i + 1 < words.size())
      request.options.triangles = std::atoi(words[++i].c_str());
    else if (words[i] == "--sentences")
      request.sentences = true;
    else
      request.garments.push_back(words[i]);
  }
  return request;
}

std::string percent(double share) {
  return fixed(100.0 * share, 2);
}

void add_row(Table& table, const Request& request, const test::ShippedExample& example, const std::string& target) {
  const std::string file = std::string(example.name) + ".json";
  StageRunner runner(nullptr, nullptr, kAlterStages);
  const double start = cpu_seconds();
  try {
    const AlterResult r = alter_garment({file, test::read_file(test::shipped_example_folder() + file)},
                                        {.name = std::string("builtin:") + example.wearer, .bytes = {}},
                                        {.name = "builtin:" + target, .bytes = {}}, request.options, runner);
    const DrapeQuality& q = r.derived.drape.quality;
    const double before = compare_fits(r.reference.mesh, r.reference.fit, r.fit_before).whole.rms_stretch;
    table.add({example.name, target, std::string(rest_name(r.reference.drape.quality.rest)),
               std::string(rest_name(q.rest)), std::to_string(q.nodes_inside), std::to_string(q.edges_inside),
               percent(q.crossing_share), percent(before), percent(r.derived.rms_stretch_error),
               std::to_string(r.derived.derivation.flipped_triangles),
               std::to_string(r.altered.ticket.operations.size()), std::to_string(r.altered.flags.size()),
               std::to_string(r.altered.sewn.flags.size()), fixed(cpu_seconds() - start, 1)});
    if (request.sentences)
      for (const auto& operation : r.altered.ticket.operations)
        std::printf("%s for %s: %s\n", example.name, target.c_str(), operation.sentence.c_str());
  } catch (const Error& error) {
    table.add(
        {example.name, target, error.message, "", "", "", "", "", "", "", "", "", "", fixed(cpu_seconds() - start, 1)});
  }
}

}  // namespace

int bench_examples(const Arguments& arguments) {
  const Request request = parse(arguments.words);
  Table table({"garment", "target", "on its own", "on target", "nodes in", "edges in", "crossing %", "before %",
               "after %", "flips", "sewn steps", "flags", "sewing flags", "CPU s"});
  for (const test::ShippedExample& example : test::kShippedExamples) {
    const auto& chosen = request.garments;
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), example.name) == chosen.end()) continue;
    for (const char* target : test::kFiveMannequins)
      if (std::string(target) != example.wearer) add_row(table, request, example, target);
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
