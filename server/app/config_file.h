// SPDX-License-Identifier: GPL-3.0-or-later
// The file of --config: a setting a line, `name = value`, without the dashes of the flag.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace toile::app {

// Gives every option of `command` that neither a flag nor a variable has set the value it has in the file; empty lines
// and lines with # in front are passed over. Nothing happens for an empty path. Throws FileUnreadable, OptionInvalid
// with file and line for what is no line of this form, an unknown name, one named twice, a value out of range.
void apply_config_file(CLI::App& command, const std::string& path);

}  // namespace toile::app
