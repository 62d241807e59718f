// SPDX-License-Identifier: GPL-3.0-or-later
// The service's log: one JSON object a line on standard error.
#pragma once

#include "jobs/worker/worker_pool.h"

namespace toile::app {

// Never holds contents of inputs or results, nor their hashes. Whole lines are written at once.
EventLog json_log();

}  // namespace toile::app
