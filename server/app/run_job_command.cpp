// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "jobs/worker/child_protocol.h"
#include "jobs/worker/run_job.h"
#include "server/app/command.h"
#include "server/app/job_kinds.h"

namespace toile::app {

// Not for users: a worker starts it, with a request on standard input.
void add_run_job_command(CLI::App& app, Context& context) {
  app.add_subcommand("run-job", "")->group("")->callback([&context] {
    JobHandlers kinds = job_kinds();
    kinds.merge(inspection_kinds());
    const int code = run_job(kinds, std::cin, kEventDescriptor, *context.progress.cancelled);
    // Without static destructors: what a library does at exit cannot turn a finished job into a failed one.
    std::_Exit(code);
  });
}

}  // namespace toile::app
