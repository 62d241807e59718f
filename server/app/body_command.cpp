// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "engine/bodies/measure_scan.h"
#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/io/body_json.h"
#include "engine/io/mesh_file.h"
#include "engine/io/record_json.h"
#include "server/app/body_source.h"
#include "server/app/command.h"
#include "server/app/files.h"

namespace toile::app {

namespace {

struct BodyArguments {
  std::string file, measurements;
  BodySource source;
  std::string out;
};

// Scans are measured through a registered mannequin; a surface that needed no closing is measured as it is.
Record measure_if_scan(ImportBodyResult& result, const Landmarks& given, Progress* progress) {
  Record how;
  if (result.body.kind != BodyKind::Human || result.repairs.holes.empty()) return how.add("by", "surface");
  MeasureScanResult scan;
  try {
    scan = measure_scan(without_patches(result.body, result.repairs.added_triangles()), given, progress);
  } catch (const Error& error) {
    if (error.code != ErrorCode::RegistrationFailed) throw;
    // The surface was measured before: less exact on a scan, and said so.
    return how.add("by", "surface").add("warnings", std::vector<std::string>{error.message});
  }
  result.body.landmarks = std::move(scan.measured.landmarks);
  result.body.measurements = std::move(scan.measured.measurements);
  return how.add("by", "registered_mannequin")
      .add("surface_mean_mm", scan.registration.surface_mean * kMmPerMetre)
      .add("surface_p95_mm", scan.registration.surface_p95 * kMmPerMetre)
      .add("estimated", scan.estimated)
      .add("warnings", scan.registration.warnings);
}

Record body_document(const ImportBodyResult& result, const Record& measured) {
  Record counts;
  counts.add("file_vertices", result.file_vertices)
      .add("file_triangles", result.file_triangles)
      .add("vertices", result.body.surface.vertex_count())
      .add("triangles", result.body.surface.triangle_count());
  const Record body = describe_body(result.body);
  Record document;
  document.add("schema", "toile/body/1");
  for (const RecordField& field : body.fields()) document.add(field.name, field.value);
  document.add("measured", measured)
      .add("normalisation", describe_normalisation(result.normalisation))
      .add("repairs", describe_repairs(result.repairs))
      .add("counts", std::move(counts));
  return document;
}

void run(const BodyArguments& arguments, Context& context) {
  if (arguments.file.empty() && arguments.measurements.empty())
    throw Error(ErrorCode::BadUsage, "toile body", "no body is named; give FILE or --measurements FILE");
  const BodyInput input =
      read_body_input(arguments.file.empty() ? arguments.measurements : arguments.file, arguments.source);
  ImportBodyResult result = take_in_body(input, &context.progress);
  const Record measured =
      measure_if_scan(result, given_landmarks(input, result.body.normalised_from_file), &context.progress);
  if (!arguments.out.empty()) write_file(arguments.out, write_obj(result.body.surface));
  const Bytes document = write_json(body_document(result, measured));
  std::fwrite(document.data(), 1, document.size(), stdout);
}

}  // namespace

void add_body_command(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<BodyArguments>();
  CLI::App* command =
      app.add_subcommand("body", "Read a body, repair and measure it; or make one from measurements. Prints JSON");
  command->footer("Example: toile body scan.obj --out body.obj > body.json");
  CLI::Option* file = command->add_option("FILE", arguments->file, std::string(kBodyHelp) + "; - is standard input");
  file->type_name("");
  command->add_option("--measurements", arguments->measurements, "Instead of FILE: make a body of tape measures (JSON)")
      ->type_name("FILE")
      ->excludes(file);
  add_body_options(*command, arguments->source);
  command->add_option("--out", arguments->out, "Write the repaired body there: OBJ, metres, standing upright")
      ->type_name("FILE");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace toile::app
