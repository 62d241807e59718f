// SPDX-License-Identifier: GPL-3.0-or-later
// Waiting for a job to change, within a limit of time and of places.
#pragma once

#include "server/http/service.h"

namespace toile::http {

// Looks again and again until `enough` holds, `seconds` have passed or the server stops; answers the last state seen.
// Throws Problem 404 when the job is not there (any more).
Job wait_for_job(Service& service, const std::string& tenant, const std::string& id, double seconds,
                 const std::function<bool(const Job&)>& enough);

// The N of `wait=N` in a Prefer header or parameter: seconds, cut to the server's limit; 0 when absent.
int wait_seconds(const Service& service, const Request& request);

}  // namespace toile::http
