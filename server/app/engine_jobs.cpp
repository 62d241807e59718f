// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/engine_jobs.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "engine/io/body_json.h"
#include "engine/io/json.h"
#include "engine/io/options_json.h"
#include "engine/io/record_json.h"
#include "engine/outputs.h"
#include "server/app/body_source.h"
#include "server/app/fit_summary.h"
#include "server/app/garment_source.h"

namespace toile::app {

using nlohmann::json;

namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string text_of(const Bytes& bytes) {
  return std::string(bytes.begin(), bytes.end());
}

Bytes bytes_of_json(const json& document) {
  const std::string text = document.dump();
  return Bytes(text.begin(), text.end());
}

BodyInput body_input(const JobInput& given) {
  const json fields = json::parse(given.fields);
  if (fields.value("format", "") == "builtin") return {"builtin:" + text_of(given.bytes), {}, {}, {}};
  BodySource source;
  source.unit = fields.value("unit", source.unit);
  source.up = fields.value("up", source.up);
  source.kind = fields.value("kind", source.kind);
  BodyInput body{given.name.empty() ? "body" : given.name, given.bytes, import_options(source), {}};
  if (fields.contains("landmarks")) body.landmarks = bytes_of_json(fields["landmarks"]);
  return body;
}

GarmentInput garment_input(const JobInput& given) {
  const json fields = json::parse(given.fields);
  GarmentInput garment{given.name.empty() ? "garment" : given.name, given.bytes};
  garment.metre_per_uv_unit = metre_per_uv_unit(fields.value("uv_unit", ""));
  garment.keep_drape = fields.value("keep_drape", false);
  if (fields.contains("seams")) garment.sidecar = bytes_of_json(fields["seams"]);
  return garment;
}

GarmentInput garment_of(const JobContext& context) {
  GarmentInput garment = garment_input(context.inputs.at("garment"));
  if (const auto worn = context.inputs.find("worn"); worn != context.inputs.end()) garment.worn = worn->second.bytes;
  return garment;
}

// Hands the files over; the report quotes the result and the clocks.
JobReport hand_over(const JobContext& context, std::vector<OutputFile> files, const std::vector<StageTiming>& timings) {
  files.push_back(timings_output(timings));
  JobReport report;
  for (const OutputFile& file : files) {
    context.artifact(file.name, file.content_type, file.bytes);
    if (file.name == "timings.json") report.timings = text_of(file.bytes);
    if (file.name != "result.json") continue;
    // What the files and the inputs are, the job's own document says already.
    json summary = json::parse(file.bytes);
    const json fit = fit_by_zone(file.bytes);
    if (!fit.empty()) summary["fit"] = fit;
    for (const char* told : {"inputs", "options", "files", "schema"}) summary.erase(told);
    report.summary = summary.dump();
  }
  return report;
}

}  // namespace

JobReport alter_job(const JobContext& context) {
  const AlterOptions options = read_options(bytes_of(context.options));
  const GarmentInput garment = garment_of(context);
  const BodyInput reference = body_input(context.inputs.at("reference_body"));
  const BodyInput target = body_input(context.inputs.at("target_body"));
  StageRunner runner(context.stages, context.progress, kAlterStages, context.threads);
  const AlterResult result = alter_garment(garment, reference, target, options, runner);
  return hand_over(context, alter_outputs(result, options, job_info(garment, reference, target), runner.at_once()),
                   runner.timings());
}

JobReport drape_job(const JobContext& context) {
  const AlterOptions options = read_options(bytes_of(context.options));
  const GarmentInput garment = garment_of(context);
  const BodyInput body = body_input(context.inputs.at("reference_body"));
  StageRunner runner(context.stages, context.progress, kDrapeStages, context.threads);
  const auto draped = drape_garment(garment, body, options, runner);
  return hand_over(context, drape_outputs(draped.value, options, job_info(garment, body)), runner.timings());
}

JobReport inspect_body_job(const JobContext& context) {
  const BodyInput input = body_input(context.inputs.at("input"));
  Record about;
  if (input.bytes.empty() || looks_like_json(input.bytes)) {
    const Body body = read_body(input);
    about.add("vertices", body.surface.vertex_count()).add("triangles", body.surface.triangle_count());
  } else {
    const ImportBodyResult body = import_body(input.bytes, "file", input.import, context.progress);
    if (!input.landmarks.empty()) read_landmarks(input.landmarks, "landmarks");
    about.add("vertices", body.body.surface.vertex_count())
        .add("triangles", body.body.surface.triangle_count())
        .add("normalisation", describe_normalisation(body.normalisation))
        .add("repairs", describe_repairs(body.repairs));
  }
  return {text_of(write_json(about)), "{}"};
}

JobReport inspect_garment_job(const JobContext& context) {
  const Pattern pattern = read_garment(garment_input(context.inputs.at("input")));
  std::vector<std::string> panels;
  for (const Panel& panel : pattern.panels) panels.push_back(panel.name);
  Record about;
  about.add("panels", std::move(panels)).add("seams", static_cast<std::int64_t>(pattern.seams.size()));
  return {text_of(write_json(about)), "{}"};
}

std::string complete_options(const std::string& kind, const std::string& options) {
  if (kind != "alter" && kind != "drape") return options;
  try {
    const AlterOptions read = read_options(bytes_of(options));
    check_outputs(read, kind == "drape" ? JobWork::Drape : JobWork::Alter);
    return json::parse(write_options(read)).dump();
  } catch (const Error& error) {
    throw Error(error.code, "/options" + error.subject, error.message);
  }
}

}  // namespace toile::app
