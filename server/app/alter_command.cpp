// SPDX-License-Identifier: GPL-3.0-or-later
// toile alter and toile drape: one job, from files to a folder of files.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "engine/core/content_hash.h"
#include "engine/io/options_json.h"
#include "engine/outputs.h"
#include "server/app/body_source.h"
#include "server/app/command.h"
#include "server/app/files.h"

namespace toile::app {
namespace {

struct JobFiles {
  std::string garment, reference_body, target_body, options, out;
  std::string uv_unit, sidecar;
  bool keep_drape = false;
  BodySource reference_source, target_source;
  std::map<std::string, std::string> given;  // option name -> value, as on the command line
};

GarmentInput read_garment_input(const JobFiles& files) {
  GarmentInput input{std::filesystem::path(files.garment).filename().string(), read_file(files.garment)};
  if (!files.uv_unit.empty())
    input.metre_per_uv_unit = files.uv_unit == "mm" ? 1e-3 : files.uv_unit == "cm" ? 1e-2 : 1.0;
  if (!files.sidecar.empty()) input.sidecar = read_file(files.sidecar);
  input.keep_drape = files.keep_drape;
  return input;
}

// The file first, then what the command line says.
AlterOptions options_of(const JobFiles& files) {
  AlterOptions options = files.options.empty() ? AlterOptions() : read_options(read_file(files.options));
  for (const auto& [name, value] : files.given) set_option(options, name, value);
  return options;
}

void write_outputs(const std::string& folder, const std::vector<OutputFile>& files) {
  for (const OutputFile& file : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / file.name;
    write_file(path, file.bytes);
    std::printf("%s\n", path.c_str());
  }
}

void alter(const JobFiles& files, Context& context) {
  const AlterOptions options = options_of(files);
  const GarmentInput garment = read_garment_input(files);
  const BodyInput reference = read_body_input(files.reference_body, files.reference_source);
  const BodyInput target = read_body_input(files.target_body, files.target_source);
  StageRunner runner(nullptr, &context.progress, kAlterStages);
  const AlterResult result = alter_garment(garment, reference, target, options, runner);
  write_outputs(files.out, alter_outputs(result, options, job_info(garment, reference, target)));
  write_outputs(files.out, {timings_output(runner.timings())});
}

void drape_one(const JobFiles& files, Context& context) {
  const AlterOptions options = options_of(files);
  const GarmentInput garment = read_garment_input(files);
  const BodyInput body = read_body_input(files.reference_body, files.reference_source);
  StageRunner runner(nullptr, &context.progress, kDrapeStages);
  const auto draped = drape_garment(garment, body, options, runner);
  write_outputs(files.out, drape_outputs(draped.value, options, job_info(garment, body)));
  write_outputs(files.out, {timings_output(runner.timings())});
}

std::string help_of(const OptionInfo& info) {
  std::string help = "default " + info.default_json;
  for (std::size_t i = 0; i < info.choices.size(); ++i) help += (i == 0 ? "; " : ", ") + info.choices[i];
  return help;
}

// --stretch-limit for stretch_limit, and so on for every option of a job.
void add_job_options(CLI::App& command, const std::shared_ptr<JobFiles>& files) {
  command
      .add_option("--garment", files->garment, "GarmentCode specification (JSON), or OBJ with its pattern as texture")
      ->required();
  command.add_option("--uv-unit", files->uv_unit, "unit of an OBJ's texture coordinates; found when left out")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  command.add_flag("--keep-drape", files->keep_drape, "take the positions of an OBJ garment as its drape, unmoved");
  command.add_option("--seams", files->sidecar, "document beside an OBJ: seams of a flat one, labels, toile block");
  command.add_option("--options", files->options, "options of the job (JSON)");
  command.add_option("--out", files->out, "folder for the results; made if needed")->required();
  for (const OptionInfo& info : list_options()) {
    std::string flag = "--" + info.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    command.add_option_function<std::string>(
        flag, [files, name = info.name](const std::string& value) { files->given[name] = value; }, help_of(info));
  }
}

}  // namespace

void add_alter_command(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("alter", "alter a garment from a reference body to a target body");
  auto files = std::make_shared<JobFiles>();
  add_job_options(*command, files);
  command->add_option("--reference-body", files->reference_body, "body it fits: OBJ, PLY, STL or builtin:NAME")
      ->required();
  command->add_option("--target-body", files->target_body, "body it shall fit")->required();
  add_body_options(*command, files->target_source);
  command->add_option("--target-landmarks", files->target_source.landmarks, "the same as --landmarks");
  command->add_option("--reference-landmarks", files->reference_source.landmarks,
                      "JSON of known landmarks of the reference body, in its file's frame");
  command->callback([files, &context] { alter(*files, context); });
}

void add_drape_command(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("drape", "drape a garment on a body and show how it fits");
  auto files = std::make_shared<JobFiles>();
  add_job_options(*command, files);
  command->add_option("--body", files->reference_body, "OBJ, PLY, STL or builtin:NAME")->required();
  add_body_options(*command, files->reference_source);
  command->callback([files, &context] { drape_one(*files, context); });
}

}  // namespace toile::app
