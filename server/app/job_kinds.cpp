// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/job_kinds.h"

namespace toile::app {

JobHandlers job_kinds() {
  JobHandlers kinds;
  add_test_job_kinds(kinds);
  return kinds;
}

}  // namespace toile::app
