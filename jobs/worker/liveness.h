// SPDX-License-Identifier: GPL-3.0-or-later
// Which worker processes of this machine are alive: each holds a lock on a file of its name, which the kernel lets go
// when the process dies. A dead worker's jobs need not wait for their lease to run out.
#pragma once

#include <string>
#include <vector>

#include "jobs/store/store.h"

namespace toile {

// Creates and locks the file; answers its descriptor, which must stay open for as long as the worker lives.
int hold_liveness(const Store& store, const std::string& worker);
void drop_liveness(const Store& store, const std::string& worker, int descriptor);
// Names of workers that died without dropping theirs; each is answered to one caller only.
std::vector<std::string> bury_dead_workers(const Store& store);

}  // namespace toile
