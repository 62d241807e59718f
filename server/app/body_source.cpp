// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/body_source.h"

#include <filesystem>

#include "engine/io/body_json.h"
#include "engine/stages/find_skeleton.h"
#include "engine/stages/make_form.h"
#include "server/app/files.h"

namespace toile::app {

namespace {

constexpr std::string_view kBuiltin = "builtin:";

ImportBodyOptions import_options(const BodySource& source) {
  ImportBodyOptions options;
  options.kind = source.kind == "form" ? BodyKind::Form : BodyKind::Human;
  for (const LengthUnit unit : {LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre, LengthUnit::Inch})
    if (source.unit == unit_name(unit)) options.unit = unit;
  for (const UpAxis up : {UpAxis::PlusX, UpAxis::MinusX, UpAxis::PlusY, UpAxis::MinusY, UpAxis::PlusZ, UpAxis::MinusZ})
    if (source.up == up_name(up)) options.up = up;
  return options;
}

}  // namespace

void add_body_options(CLI::App& app, BodySource& source) {
  app.add_option("--unit", source.unit, "unit of the file")
      ->check(CLI::IsMember({"auto", "m", "cm", "mm", "in"}))
      ->capture_default_str();
  app.add_option("--up", source.up, "axis that points to the head; a form: +y unless given")
      ->check(CLI::IsMember({"auto", "+x", "-x", "+y", "-y", "+z", "-z"}))
      ->capture_default_str();
  app.add_option("--kind", source.kind, "human, or form: any closed upright shape, taken as it stands")
      ->check(CLI::IsMember({"human", "form"}))
      ->capture_default_str();
  app.add_option("--landmarks", source.landmarks, "JSON of known landmarks, in the file's frame");
}

ImportBodyResult load_body(const std::string& file, const BodySource& source, Progress* progress) {
  if (file.starts_with(kBuiltin)) {
    ImportBodyResult result;
    result.body = make_builtin_form(file.substr(kBuiltin.size()));
    result.file_vertices = result.body.surface.vertex_count();
    result.file_triangles = result.body.surface.triangle_count();
    return result;
  }
  ImportBodyResult result = import_body(read_file(file), file, import_options(source), progress);
  Body& body = result.body;
  body.name = std::filesystem::path(file).stem().string();
  if (!source.landmarks.empty())
    body.landmarks =
        normalised_landmarks(read_landmarks(read_file(source.landmarks), source.landmarks), body.normalised_from_file);
  if (body.kind == BodyKind::Human) body.skeleton = find_skeleton(body.surface).skeleton;
  return result;
}

}  // namespace toile::app
