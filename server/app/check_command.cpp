// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cstdio>

#include "engine/bodies/import_body.h"
#include "engine/core/error.h"
#include "engine/io/json.h"
#include "engine/io/options_json.h"
#include "engine/io/schema_check.h"
#include "engine/stages/import_pattern.h"
#include "server/app/command.h"
#include "server/app/files.h"

namespace toile::app {

namespace {

// What a schema cannot say: outlines, seams, ranges that hang together.
void check_contents(const Bytes& bytes, const std::string& schema, Context& context) {
  if (schema == "garment" || schema == "altered_pattern") import_pattern(bytes, &context.progress);
  if (schema == "options") read_options(bytes);
}

std::string check_document(const Bytes& bytes, const std::string& schema_name, Context& context) {
  const SchemaCheck check = check_schema(bytes, schema_name);
  if (!check.problems.empty()) {
    for (std::size_t i = 1; i < check.problems.size(); ++i)
      std::fprintf(stderr, "%s: %s\n", check.problems[i].pointer.c_str(), check.problems[i].message.c_str());
    throw Error(ErrorCode::FileMalformed, check.problems[0].pointer,
                check.problems[0].message + "; correct it to agree with the schema \"" + check.schema + "\"");
  }
  check_contents(bytes, check.schema, context);
  return check.schema;
}

bool has_texture(const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.find("\nvt ") != text.npos;
}

// An OBJ with texture coordinates is a garment unless it is a body.
std::string check_mesh(const Bytes& bytes, const std::string& path, Context& context) {
  try {
    const ImportBodyResult result = import_body(bytes, path, {}, &context.progress);
    return "body, " + std::to_string(result.file_vertices) + " vertices, " + std::to_string(result.file_triangles) +
           " triangles";
  } catch (const Error& error) {
    const bool no_body = error.code == ErrorCode::BodyUnusable || error.code == ErrorCode::BodyNotRecognised;
    if (!no_body || !has_texture(bytes)) throw;
  }
  const ImportedGarment garment = import_garment(bytes, path, {}, &context.progress);
  return "garment, " + std::to_string(garment.pattern.panels.size()) + " panels, " +
         std::to_string(garment.pattern.seams.size()) + " seams";
}

void run_check(const std::string& path, const std::string& schema, Context& context) {
  const Bytes bytes = read_file(path);
  try {
    const bool document = !schema.empty() || looks_like_json(bytes);
    const std::string what = document ? check_document(bytes, schema, context) : check_mesh(bytes, path, context);
    std::printf("%s: valid (%s)\n", path.c_str(), what.c_str());
  } catch (const Error& error) {
    if (error.code == ErrorCode::FormatUnknown && error.subject == path)
      throw Error(error.code, path, "neither a JSON document nor a mesh as OBJ, PLY or STL: " + error.message);
    if (error.subject == path) throw;
    const bool pointer = error.subject.starts_with('/');
    throw Error(error.code, path + (pointer ? "#" : ": ") + error.subject, error.message);
  }
}

}  // namespace

void add_check_command(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "check", "Tell whether a file of a garment, body, options or result is valid, and where it is not");
  auto path = std::make_shared<std::string>();
  auto schema = std::make_shared<std::string>();
  command->add_option("FILE", *path, "JSON document, or a mesh as OBJ, PLY, STL; - is standard input")
      ->type_name("")
      ->required();
  command->add_option("--schema", *schema, "Kind of document, where it does not tell by itself")
      ->check(CLI::IsMember(schema_names()));
  command->callback([path, schema, &context] { run_check(*path, *schema, context); });
}

}  // namespace toile::app
