// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of job this program can do, wired to the engine.
#pragma once

#include "jobs/worker/job_handler.h"

namespace toile::app {

JobHandlers job_kinds();
// What looks into uploads before they are stored; not to be asked for by clients.
JobHandlers inspection_kinds();

// Kinds that crash, loop and eat memory on purpose. The shipped program has none; the program of the tests has them.
void add_test_job_kinds(JobHandlers& kinds);

}  // namespace toile::app
