// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies as the command line names them.
#pragma once

#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "engine/pipeline_inputs.h"

namespace toile::app {

inline constexpr std::string_view kBuiltin = "builtin:";  // begins the name of a shipped body
inline constexpr const char* kBodyHelp =
    "a mesh (OBJ, PLY, STL), tape measures (JSON) or a shipped body, builtin:woman-38-168";

// How one body is to be read; `add_body_options` binds it to --unit, --up and --kind.
struct BodySource {
  std::string unit = "auto";   // auto, m, cm, mm, in
  std::string up = "auto";     // auto, +x, -x, +y, -y, +z, -z
  std::string kind = "human";  // human, form
  std::string landmarks;       // file of given landmarks, or empty
};
void add_body_options(CLI::App& app, BodySource& source);
ImportBodyOptions import_options(const BodySource& source);

// A file (OBJ, PLY, STL; "-" is standard input) or `builtin:NAME`. Throws FileUnreadable, LimitExceeded.
BodyInput read_body_input(const std::string& file, const BodySource& source);

}  // namespace toile::app
