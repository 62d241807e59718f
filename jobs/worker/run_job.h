// SPDX-License-Identifier: GPL-3.0-or-later
// The child's side of a job: reads the request, runs the handler, writes artifacts into the working folder and tells
// how it ended. This is the only place of the service where engine errors are caught.
#pragma once

#include <atomic>
#include <iosfwd>

#include "jobs/worker/job_handler.h"

namespace toile {

// `requests` is standard input, `events` a descriptor; the working folder is the scratch folder. `cancelled` is set by
// SIGTERM. Answers the exit code: 0 when the end (good or bad) was told.
int run_job(const JobHandlers& handlers, std::istream& requests, int events, const std::atomic<bool>& cancelled);

}  // namespace toile
