// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/job_kinds.h"

namespace toile::app {

void add_test_job_kinds(JobHandlers&) {}

}  // namespace toile::app
