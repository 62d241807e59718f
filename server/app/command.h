// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands of `toile`. Each file <name>_command.cpp adds its own; main.cpp lists them and maps errors to exit
// codes.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

#include "engine/core/progress.h"

namespace toile::app {

// What every subcommand shares.
struct Context {
  bool quiet = false;
  bool json_log = false;
  int threads = 0;    // 0: as many as there are cores
  Progress progress;  // a bar on a terminal, one line per stage otherwise; cancelled by SIGINT and SIGTERM
};

// How many threads the subcommand may use.
inline int threads_of(const Context& context) {
  return context.threads > 0 ? context.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// Adds the subcommand's options to `app` and sets what it runs as its callback.
void add_alter_command(CLI::App& app, Context& context);
void add_batch_command(CLI::App& app, Context& context);
void add_body_command(CLI::App& app, Context& context);
void add_check_command(CLI::App& app, Context& context);
void add_drape_command(CLI::App& app, Context& context);
void add_register_command(CLI::App& app, Context& context);
void add_version_command(CLI::App& app, Context& context);
void add_serve_command(CLI::App& app, Context& context);
void add_work_command(CLI::App& app, Context& context);
void add_run_job_command(CLI::App& app, Context& context);

}  // namespace toile::app
