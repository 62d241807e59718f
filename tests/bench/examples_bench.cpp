// SPDX-License-Identifier: GPL-3.0-or-later
// examples [GARMENT...] [--triangles N] [--sentences] [--pictures FOLDER]: every drafted example draped on the
// mannequin it was drafted for and on the others of five as it is, by its target pattern, and as altered: rest, what
// lies inside the body or crosses, fit, flips, area, and what is sewn. Pictures: how each fits, and what to cut.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "engine/outputs.h"
#include "tests/bench/bench.h"
#include "tests/bench/words.h"
#include "tests/support/shared_data.h"
#include "tests/support/shipped_examples.h"

namespace toile::bench {
namespace {

struct ExamplesRequest {
  std::vector<std::string> garments;
  AlterOptions options;
  std::string pictures;  // folder, or empty
  bool sentences = false;
};

ExamplesRequest examples_request(Words words) {
  ExamplesRequest request;
  request.options.triangles = words.integer("--triangles").value_or(4000);
  request.options.outputs = {"fit_reference.png", "fit_before.png", "fit_target.png", "fit_after.png", "pattern.png"};
  request.pictures = words.text("--pictures").value_or("");
  request.sentences = words.flag("--sentences");
  request.garments = words.rest();
  return request;
}

// "converged 0/0 0.0": rest, nodes and edges inside the body, share of triangles that cross, in percent.
std::string state(const DrapeQuality& q) {
  return std::string(rest_name(q.rest)) + " " + std::to_string(q.nodes_inside) + "/" + std::to_string(q.edges_inside) +
         " " + fixed(100.0 * q.crossing_share, 1);
}

void write_pictures(const std::string& folder, const std::string& name, const std::vector<OutputFile>& files) {
  std::filesystem::create_directories(folder);
  for (const OutputFile& file : files)
    if (file.content_type == "image/png")
      std::ofstream(folder + "/" + name + "_" + file.name, std::ios::binary)
          .write(reinterpret_cast<const char*>(file.bytes.data()), static_cast<std::streamsize>(file.bytes.size()));
}

std::vector<std::string> row_of(const AlterResult& r) {
  const PatternMesh& mesh = r.reference.mesh;
  const bool sewn = r.after && r.after->problem.empty();
  const double before = compare_fits(mesh, r.reference.fit, r.fit_before).whole.rms_stretch;
  return {state(r.reference.drape.quality),
          state(r.before->quality),
          state(r.derived.drape.quality),
          sewn      ? state(r.after->drape.quality)
          : r.after ? r.after->problem
                    : "",
          percent(before, 2),
          percent(r.derived.rms_stretch_error, 2),
          sewn ? percent(compare_fits(r.after->mesh, r.after->reference, r.after->fit).whole.rms_stretch, 2) : "",
          std::to_string(r.derived.derivation.flipped_triangles),
          percent(r.altered.area_imbalance, 2),
          std::to_string(r.altered.ticket.operations.size()),
          std::to_string(r.altered.flags.size()),
          std::to_string(r.altered.sewn.flags.size())};
}

void add_row(Table& table, const ExamplesRequest& request, const test::ShippedExample& example,
             const std::string& target) {
  const std::string file = std::string(example.name) + ".json";
  const GarmentInput garment = {file, test::read_file(test::shipped_example_folder() + file)};
  const BodyInput wearer = {.name = std::string("builtin:") + example.wearer, .bytes = {}};
  const BodyInput body = {.name = "builtin:" + target, .bytes = {}};
  StageRunner runner(nullptr, nullptr, kAlterStages);
  const double start = cpu_seconds();
  std::vector<std::string> row = {example.name, target};
  try {
    const AlterResult r = alter_garment(garment, wearer, body, request.options, runner);
    const std::vector<std::string> figures = row_of(r);
    row.insert(row.end(), figures.begin(), figures.end());
    row.push_back(fixed(cpu_seconds() - start, 1));
    if (!request.pictures.empty())
      write_pictures(request.pictures, std::string(example.name) + "_" + target,
                     alter_outputs(r, request.options, job_info(garment, wearer, body)));
    if (request.sentences)
      for (const auto& operation : r.altered.ticket.operations)
        std::printf("%s for %s: %s\n", example.name, target.c_str(), operation.sentence.c_str());
  } catch (const Error& error) {
    row.push_back(error.message);
  }
  table.add(row);
}

}  // namespace

int bench_examples(const Arguments& arguments) {
  const ExamplesRequest request = examples_request(Words(arguments.words));
  Table table({"garment", "target", "on its own", "as it is", "target pattern", "altered", "before %", "target %",
               "altered %", "flips", "area off %", "sewn steps", "flags", "sewing flags", "CPU s"});
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
