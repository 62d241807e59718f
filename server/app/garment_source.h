// SPDX-License-Identifier: GPL-3.0-or-later
// Garments as the command line names them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "engine/pipeline_inputs.h"

namespace toile::app {

// A garment's file and how it is to be read; `add_garment_options` binds it to --garment, --uv-unit, --keep-drape,
// --seams and --worn.
struct GarmentSource {
  std::string file;
  std::string uv_unit;  // mm, cm, m, or empty: found
  bool keep_drape = false;
  std::string seams, worn;  // files beside it, or empty
};
void add_garment_options(CLI::App& app, GarmentSource& source);

// Throws FileUnreadable, LimitExceeded.
GarmentInput read_garment_input(const GarmentSource& source);
std::optional<double> metre_per_uv_unit(const std::string& uv_unit);  // as GarmentSource::uv_unit

}  // namespace toile::app
