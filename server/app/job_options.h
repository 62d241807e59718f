// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a job on the command line: every one a flag, and all of them in a file.
#pragma once

#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/outputs.h"

namespace toile::app {

struct JobOptions {
  std::string file;                          // --options
  std::map<std::string, std::string> given;  // name of the option -> its value on the command line
};

// --stretch-limit for stretch_limit, and so on. The help of a drape leaves out what only an alteration asks for.
void add_job_options(CLI::App& command, const std::shared_ptr<JobOptions>& options, JobWork work);

// The file first, then what the command line says. Throws Error{OptionInvalid} that names the flag or the file.
AlterOptions read_job_options(const JobOptions& options, JobWork work);

}  // namespace toile::app
