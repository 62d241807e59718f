// SPDX-License-Identifier: GPL-3.0-or-later
// toile alter and toile drape: one job, from files to a folder of files.
#include <cstdio>
#include <memory>

#include "engine/outputs.h"
#include "server/app/body_source.h"
#include "server/app/command.h"
#include "server/app/files.h"
#include "server/app/garment_source.h"
#include "server/app/job_options.h"

namespace toile::app {
namespace {

struct JobFiles {
  GarmentSource garment;
  std::string reference_body, target_body, out;
  BodySource reference_source, target_source;
  std::shared_ptr<JobOptions> options = std::make_shared<JobOptions>();
};

void write_outputs(const std::string& folder, const std::vector<OutputFile>& files) {
  for (const OutputFile& file : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / file.name;
    write_file(path, file.bytes);
    std::printf("%s\n", path.c_str());
  }
}

void alter(const JobFiles& files, Context& context) {
  const AlterOptions options = read_job_options(*files.options, JobWork::Alter);
  prepare_folder(files.out);
  const GarmentInput garment = read_garment_input(files.garment);
  const BodyInput reference = read_body_input(files.reference_body, files.reference_source);
  const BodyInput target = read_body_input(files.target_body, files.target_source);
  StageRunner runner(nullptr, &context.progress, kAlterStages, threads_of(context));
  const AlterResult result = alter_garment(garment, reference, target, options, runner);
  write_outputs(files.out, alter_outputs(result, options, job_info(garment, reference, target), runner.at_once()));
  write_outputs(files.out, {timings_output(runner.timings())});
}

void drape_one(const JobFiles& files, Context& context) {
  const AlterOptions options = read_job_options(*files.options, JobWork::Drape);
  prepare_folder(files.out);
  const GarmentInput garment = read_garment_input(files.garment);
  const BodyInput body = read_body_input(files.reference_body, files.reference_source);
  StageRunner runner(nullptr, &context.progress, kDrapeStages, threads_of(context));
  const auto draped = drape_garment(garment, body, options, runner);
  write_outputs(files.out, drape_outputs(draped.value, options, job_info(garment, body)));
  write_outputs(files.out, {timings_output(runner.timings())});
}

void add_out_option(CLI::App& command, JobFiles& files) {
  command.add_option("--out", files.out, "Folder for the results; made if needed")->type_name("FOLDER")->required();
}

}  // namespace

void add_alter_command(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand(
      "alter", "Alter a garment that fits one body so that it fits another the same way: what to sew, and the pattern");
  command->footer(
      "Example: toile alter --garment skirt.json --reference-body builtin:woman-38-168 --target-body scan.obj --out "
      "out/skirt\nThen open out/skirt/report.html.");
  auto files = std::make_shared<JobFiles>();
  add_garment_options(*command, files->garment);
  add_out_option(*command, *files);
  command->add_option("--reference-body", files->reference_body, std::string("Body the garment fits now: ") + kBodyHelp)
      ->type_name("BODY")
      ->required();
  command->add_option("--target-body", files->target_body, "Body it shall fit: the same, or a scan")
      ->type_name("BODY")
      ->required();
  add_body_options(*command, files->target_source);
  command->add_option("--target-landmarks", files->target_source.landmarks, "The same as --landmarks")
      ->type_name("FILE");
  command->add_option("--reference-landmarks", files->reference_source.landmarks, "The same for the reference body")
      ->type_name("FILE");
  add_job_options(*command, files->options, JobWork::Alter);
  command->callback([files, &context] { alter(*files, context); });
}

void add_drape_command(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("drape", "Put a garment on a body and show how it fits");
  command->footer(
      "Example: toile drape --garment skirt.json --body builtin:woman-38-168 --out out/fit\nThen open "
      "out/fit/fit.png.");
  auto files = std::make_shared<JobFiles>();
  add_garment_options(*command, files->garment);
  add_out_option(*command, *files);
  command->add_option("--body", files->reference_body, std::string("Body that wears it: ") + kBodyHelp)
      ->type_name("BODY")
      ->required();
  add_body_options(*command, files->reference_source);
  add_job_options(*command, files->options, JobWork::Drape);
  command->callback([files, &context] { drape_one(*files, context); });
}

}  // namespace toile::app
