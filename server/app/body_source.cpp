// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/body_source.h"

#include <filesystem>

#include "server/app/files.h"

namespace toile::app {

ImportBodyOptions import_options(const BodySource& source) {
  ImportBodyOptions options;
  options.kind = source.kind == "form" ? BodyKind::Form : BodyKind::Human;
  for (const LengthUnit unit : {LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre, LengthUnit::Inch})
    if (source.unit == unit_name(unit)) options.unit = unit;
  for (const UpAxis up : {UpAxis::PlusX, UpAxis::MinusX, UpAxis::PlusY, UpAxis::MinusY, UpAxis::PlusZ, UpAxis::MinusZ})
    if (source.up == up_name(up)) options.up = up;
  return options;
}

void add_body_options(CLI::App& app, BodySource& source) {
  app.add_option("--unit", source.unit, "Unit of the body's file")
      ->check(CLI::IsMember({"auto", "m", "cm", "mm", "in"}))
      ->capture_default_str();
  app.add_option("--up", source.up, "Axis of the body's file that points to the head")
      ->check(CLI::IsMember({"auto", "+x", "-x", "+y", "-y", "+z", "-z"}))
      ->capture_default_str();
  app.add_option("--kind", source.kind, "human, or form: a dress form or any closed upright shape, taken as it stands")
      ->check(CLI::IsMember({"human", "form"}))
      ->capture_default_str();
  app.add_option("--landmarks", source.landmarks,
                 "Known points of the body, by the names that toile body prints, such as crotch or wrist_l (JSON)")
      ->type_name("FILE");
}

BodyInput read_body_input(const std::string& file, const BodySource& source) {
  BodyInput input;
  input.name = file.starts_with(kBuiltin) ? file : std::filesystem::path(file).filename().string();
  if (!file.starts_with(kBuiltin)) input.bytes = read_file(file);
  if (!source.landmarks.empty()) input.landmarks = read_file(source.landmarks);
  input.import = import_options(source);
  return input;
}

}  // namespace toile::app
