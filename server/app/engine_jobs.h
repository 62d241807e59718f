// SPDX-License-Identifier: GPL-3.0-or-later
// The engine as kinds of job: bytes and JSON in, artifacts out.
#pragma once

#include "jobs/worker/job_handler.h"

namespace toile::app {

JobReport alter_job(const JobContext& context);  // roles garment, reference_body, target_body; may have worn
JobReport drape_job(const JobContext& context);  // roles garment, reference_body; may have worn

// Import alone: refuses what no job could use; the summary says what was found. One input, of role "input".
JobReport inspect_body_job(const JobContext& context);
JobReport inspect_garment_job(const JobContext& context);

// A job's options with all defaults written out. Throws Error{OptionInvalid} with subject "/options/...".
std::string complete_options(const std::string& kind, const std::string& options);

}  // namespace toile::app
