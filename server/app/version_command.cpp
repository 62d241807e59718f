// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "server/app/command.h"

namespace toile::app {

void add_version_command(CLI::App& app, Context&) {
  app.add_subcommand("version", "Print the version")->callback([] { std::puts("toile " TOILE_VERSION); });
}

}  // namespace toile::app
