// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

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

Record body_document(const ImportBodyResult& result) {
  Record counts;
  counts.add("file_vertices", result.file_vertices)
      .add("file_triangles", result.file_triangles)
      .add("vertices", result.body.surface.vertex_count())
      .add("triangles", result.body.surface.triangle_count());
  const Record body = describe_body(result.body);
  Record document;
  document.add("schema", "toile/body/1");
  for (const RecordField& field : body.fields()) document.add(field.name, field.value);
  document.add("normalisation", describe_normalisation(result.normalisation))
      .add("repairs", describe_repairs(result.repairs))
      .add("counts", std::move(counts));
  return document;
}

void run(const BodyArguments& arguments, Context& context) {
  const ImportBodyResult result =
      take_in_body(read_body_input(arguments.file.empty() ? arguments.measurements : arguments.file, arguments.source),
                   &context.progress);
  if (!arguments.out.empty()) write_file(arguments.out, write_obj(result.body.surface));
  const Bytes document = write_json(body_document(result));
  std::fwrite(document.data(), 1, document.size(), stdout);
}

}  // namespace

void add_body_command(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<BodyArguments>();
  CLI::App* command = app.add_subcommand("body", "import, repair and measure a body; one JSON document on stdout");
  CLI::App* from = command->add_option_group("body")->require_option(1);
  from->add_option("FILE", arguments->file, "OBJ, PLY or STL; a measurements JSON; builtin:NAME; - is standard input");
  from->add_option("--measurements", arguments->measurements, "make a mannequin of these (JSON)");
  add_body_options(*command, arguments->source);
  command->add_option("--out", arguments->out, "write the normalised body there, as OBJ in metres");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace toile::app
