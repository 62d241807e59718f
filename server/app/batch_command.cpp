// SPDX-License-Identifier: GPL-3.0-or-later
// toile batch: one garment, many bodies. What the bodies share is done once; a batch that was broken off goes on where
// it was.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "engine/core/content_hash.h"
#include "engine/io/options_json.h"
#include "engine/outputs.h"
#include "server/app/body_source.h"
#include "server/app/command.h"
#include "server/app/files.h"
#include "server/app/fit_summary.h"
#include "server/app/folder_stages.h"
#include "server/app/garment_source.h"
#include "server/app/job_options.h"
#include "server/http/batch_report.h"

namespace toile::app {

namespace fs = std::filesystem;

namespace {

struct BatchFiles {
  GarmentSource garment;
  std::string reference_body, target_bodies, out;
  std::shared_ptr<JobOptions> options = std::make_shared<JobOptions>();
  BodySource source;
};

bool is_body_file(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".json";
}

std::vector<std::string> bodies_in_folder(const std::string& folder) {
  std::error_code failed;
  std::vector<std::string> bodies;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (is_body_file(entry.path())) bodies.push_back(entry.path().string());
  if (failed)
    throw Error(ErrorCode::FileUnreadable, "--target-bodies " + folder,
                "cannot be read: " + failed.message() + "; check its permissions");
  std::sort(bodies.begin(), bodies.end());
  // JSON beside a mesh of the same name tells of it and is no further body.
  std::erase_if(bodies, [](const fs::path& body) {
    const auto has = [&](const char* extension) { return fs::exists(fs::path(body).replace_extension(extension)); };
    return body.extension() == ".json" && (has(".obj") || has(".ply") || has(".stl"));
  });
  return bodies;
}

std::vector<std::string> bodies_in_list(const std::string& list) {
  const Bytes bytes = read_file(list);
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  std::vector<std::string> bodies;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const bool plain = line.starts_with(kBuiltin) || fs::path(line).is_absolute();
    bodies.push_back(plain ? line : (fs::path(list).parent_path() / line).string());
  }
  return bodies;
}

// The bodies of a folder by name, the lines of a list (files relative to it, or builtin:NAME), or the one body named.
std::vector<std::string> bodies_of(const std::string& source) {
  if (source.starts_with(kBuiltin)) return {source};
  std::error_code unknown;
  const bool folder = fs::is_directory(source, unknown);
  if (!folder && is_body_file(source)) return {source};
  std::vector<std::string> bodies = folder ? bodies_in_folder(source) : bodies_in_list(source);
  if (bodies.empty())
    throw Error(ErrorCode::BadUsage, "--target-bodies",
                "no body in " + source + ": give a folder of OBJ, PLY or STL files, or a list");
  return bodies;
}

// A folder name no two bodies share.
std::string folder_of(const std::string& body, std::map<std::string, int>& used) {
  std::string name = body.starts_with(kBuiltin) ? body.substr(kBuiltin.size()) : fs::path(body).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c == '/' || c < 32; }, '_');
  const int count = ++used[name];
  return count == 1 ? name : name + "-" + std::to_string(count);
}

class Batch {
 public:
  Batch(const BatchFiles& files, Context& context)
      : files_(files),
        context_(context),
        options_(read_job_options(*files.options, JobWork::Alter)),
        garment_(read_garment_input(files.garment)),
        reference_(read_body_input(files.reference_body, BodySource{})),
        stages_(fs::path(files.out) / ".stages") {}

  int run() {
    const std::vector<std::string> bodies = bodies_of(files_.target_bodies);
    prepare_folder(files_.out);
    std::map<std::string, int> used;
    std::vector<http::BatchRow> rows;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      rows.push_back(one(bodies[i], folder_of(bodies[i], used), i, bodies.size()));
      report(rows);
    }
    std::printf("%s\n", (fs::path(files_.out) / "summary.html").c_str());
    return static_cast<int>(
        std::count_if(rows.begin(), rows.end(), [](const http::BatchRow& row) { return !row.error.empty(); }));
  }

 private:
  http::BatchRow one(const std::string& file, const std::string& folder, std::size_t index, std::size_t count) {
    http::BatchRow row;
    row.body = file;
    row.link = folder + "/";
    const fs::path out = fs::path(files_.out) / folder;
    try {
      const BodyInput target = read_body_input(file, files_.source);
      const std::string key = key_of(std::string(TOILE_VERSION), input_key(garment_), input_key(reference_),
                                     input_key(target), write_options(options_));
      if (!is_done(out, key)) work(target, out, key, index, count);
      row.fit = fit_by_zone(read_file((out / "result.json").string()));
    } catch (const Error& error) {
      if (error.code == ErrorCode::Cancelled) throw;
      row.status = http::BatchRowStatus::Failed;
      row.error = std::string(error_name(error.code)) + ": " + error.what();
      if (!context_.quiet) std::fprintf(stderr, "toile: %s\n", row.error.c_str());
    }
    return row;
  }

  static bool is_done(const fs::path& out, const std::string& key) {
    std::ifstream in(out / ".key");
    std::string found;
    return std::getline(in, found) && found == key;
  }

  void work(const BodyInput& target, const fs::path& out, const std::string& key, std::size_t index,
            std::size_t count) {
    Progress progress;
    progress.cancelled = context_.progress.cancelled;
    const std::string caption = std::to_string(index + 1) + "/" + std::to_string(count) + " " + out.filename().string();
    progress.report = [&](std::string_view, double fraction) {
      if (context_.progress.report) context_.progress.report(caption, fraction);
    };
    StageRunner runner(&stages_, &progress, kAlterStages, threads_of(context_));
    const AlterResult result = alter_garment(garment_, reference_, target, options_, runner);
    std::vector<OutputFile> made =
        alter_outputs(result, options_, job_info(garment_, reference_, target), runner.at_once());
    made.push_back(timings_output(runner.timings()));
    for (const OutputFile& file : made) write_file(out / file.name, file.bytes);
    write_file(out / ".key", Bytes(key.begin(), key.end()));
  }

  void report(const std::vector<http::BatchRow>& rows) const {
    const std::string csv = http::batch_csv(rows), html = http::batch_html(garment_.name, rows);
    write_file(fs::path(files_.out) / "summary.csv", Bytes(csv.begin(), csv.end()));
    write_file(fs::path(files_.out) / "summary.html", Bytes(html.begin(), html.end()));
  }

  const BatchFiles& files_;
  Context& context_;
  const AlterOptions options_;
  const GarmentInput garment_;
  const BodyInput reference_;
  FolderStages stages_;
};

}  // namespace

void add_batch_command(CLI::App& app, Context& context) {
  auto files = std::make_shared<BatchFiles>();
  CLI::App* command = app.add_subcommand(
      "batch", "Alter one garment for many bodies; started again, it goes on where it was broken off");
  command->footer(
      "Example: toile batch --garment skirt.json --reference-body builtin:woman-38-168 --target-bodies scans/ --out "
      "out/all\nThen open out/all/summary.html.");
  add_garment_options(*command, files->garment);
  command->add_option("--reference-body", files->reference_body, std::string("Body the garment fits now: ") + kBodyHelp)
      ->type_name("BODY")
      ->required();
  command
      ->add_option("--target-bodies", files->target_bodies,
                   "Bodies it shall fit: a folder of body files, a text file with one body a line, or one body")
      ->type_name("FOLDER|FILE")
      ->required();
  command->add_option("--out", files->out, "Folder for the results; made if needed")->type_name("FOLDER")->required();
  add_body_options(*command, files->source);
  add_job_options(*command, files->options, JobWork::Alter);
  command->callback([files, &context] {
    const int failed = Batch(*files, context).run();
    if (failed > 0)
      throw Error(ErrorCode::AlterationFailed, "batch",
                  std::to_string(failed) + (failed == 1 ? " body" : " bodies") + " could not be fitted; " +
                      (fs::path(files->out) / "summary.csv").string() + " tells why");
  });
}

}  // namespace toile::app
