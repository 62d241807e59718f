// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/job_kinds.h"

#include "server/app/engine_jobs.h"

namespace toile::app {

JobHandlers job_kinds() {
  JobHandlers kinds = {{"alter", alter_job}, {"drape", drape_job}};
  add_test_job_kinds(kinds);
  return kinds;
}

JobHandlers inspection_kinds() {
  return {{"inspect_body", inspect_body_job}, {"inspect_garment", inspect_garment_job}};
}

}  // namespace toile::app
