// SPDX-License-Identifier: GPL-3.0-or-later
// toile alter and toile drape: one job, from files to a folder of files.
#include <cstdio>
#include <memory>

#include "engine/core/content_hash.h"
#include "engine/outputs.h"
#include "server/app/command.h"
#include "server/app/files.h"

namespace toile::app {
namespace {

struct JobFiles {
  std::string garment, reference_body, target_body, options, out;
  std::optional<int> triangles;
};

bool is_builtin(const std::string& name) {
  return name.starts_with("builtin:");
}

BodyInput read_body_input(const std::string& file) {
  return {file, is_builtin(file) ? Bytes() : read_file(file)};
}

std::string file_name(const std::string& path) {
  return is_builtin(path) ? path : std::filesystem::path(path).filename().string();
}

void write_outputs(const std::string& folder, const std::vector<OutputFile>& files) {
  for (const OutputFile& file : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / file.name;
    write_file(path, file.bytes);
    std::printf("%s\n", path.c_str());
  }
}

AlterOptions options_of(const JobFiles& files) {
  AlterOptions options;
  if (files.triangles) options.triangles = files.triangles;
  return options;
}

void alter(const JobFiles& files, Context& context) {
  const AlterOptions options = options_of(files);
  const GarmentInput garment{file_name(files.garment), read_file(files.garment)};
  const BodyInput reference = read_body_input(files.reference_body), target = read_body_input(files.target_body);
  StageRunner runner(nullptr, &context.progress, kAlterStages);
  const AlterResult result = alter_garment(garment, reference, target, options, runner);
  const JobInfo info{garment.name,
                     file_name(files.reference_body),
                     file_name(files.target_body),
                     sha256_hex(garment.bytes),
                     sha256_hex(reference.bytes),
                     sha256_hex(target.bytes)};
  write_outputs(files.out, alter_outputs(result, options, info));
  write_outputs(files.out, {timings_output(runner.timings())});
}

void drape_one(const JobFiles& files, Context& context) {
  const AlterOptions options = options_of(files);
  const GarmentInput garment{file_name(files.garment), read_file(files.garment)};
  const BodyInput body = read_body_input(files.reference_body);
  StageRunner runner(nullptr, &context.progress, kDrapeStages);
  const auto draped = drape_garment(garment, body, options, runner);
  const JobInfo info{
      garment.name, file_name(files.reference_body), "", sha256_hex(garment.bytes), sha256_hex(body.bytes), ""};
  write_outputs(files.out, drape_outputs(draped.value, options, info));
  write_outputs(files.out, {timings_output(runner.timings())});
}

void add_common(CLI::App& command, JobFiles& files) {
  command.add_option("--garment", files.garment, "GarmentCode specification (JSON)")->required();
  command.add_option("--out", files.out, "folder for the results; made if needed")->required();
  command.add_option("--triangles", files.triangles, "of the garment, 500 to 200000")->check(CLI::Range(500, 200000));
}

}  // namespace

void add_alter_command(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("alter", "alter a garment from a reference body to a target body");
  auto files = std::make_shared<JobFiles>();
  add_common(*command, *files);
  command->add_option("--reference-body", files->reference_body, "body it fits: OBJ, PLY, STL or builtin:NAME")
      ->required();
  command->add_option("--target-body", files->target_body, "body it shall fit")->required();
  command->callback([files, &context] { alter(*files, context); });
}

void add_drape_command(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("drape", "drape a garment on a body and show how it fits");
  auto files = std::make_shared<JobFiles>();
  add_common(*command, *files);
  command->add_option("--body", files->reference_body, "OBJ, PLY, STL or builtin:NAME")->required();
  command->callback([files, &context] { drape_one(*files, context); });
}

}  // namespace toile::app
