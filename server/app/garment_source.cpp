// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/garment_source.h"

#include <filesystem>

#include "server/app/files.h"

namespace toile::app {

void add_garment_options(CLI::App& app, GarmentSource& source) {
  app.add_option("--garment", source.file,
                 "Garment: a GarmentCode pattern (JSON), or a 3D garment (OBJ) whose texture is its pattern")
      ->type_name("FILE")
      ->required();
  app.add_option("--uv-unit", source.uv_unit, "OBJ garment: unit of its pattern; found when left out")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  app.add_flag("--keep-drape", source.keep_drape, "OBJ garment: it hangs as it should, do not drape it anew");
  app.add_option("--seams", source.seams, "OBJ garment: file beside it with seams, names of panels, allowances (JSON)")
      ->type_name("FILE");
  app.add_option(
         "--worn", source.worn,
         "Pattern out of an earlier alteration (target_pattern.json): the target_worn.obj beside it. The fit it "
         "was derived for is asked for again, so that the errors of both times do not add up")
      ->type_name("FILE");
}

std::optional<double> metre_per_uv_unit(const std::string& uv_unit) {
  if (uv_unit.empty()) return std::nullopt;
  return uv_unit == "mm" ? 1e-3 : uv_unit == "cm" ? 1e-2 : 1.0;
}

GarmentInput read_garment_input(const GarmentSource& source) {
  GarmentInput input{std::filesystem::path(source.file).filename().string(), read_file(source.file)};
  input.metre_per_uv_unit = metre_per_uv_unit(source.uv_unit);
  if (!source.seams.empty()) input.sidecar = read_file(source.seams);
  input.keep_drape = source.keep_drape;
  if (!source.worn.empty()) input.worn = read_file(source.worn);
  return input;
}

}  // namespace toile::app
