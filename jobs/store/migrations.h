// SPDX-License-Identifier: GPL-3.0-or-later
// The tables, as a list of steps; PRAGMA user_version counts the steps a database has taken.
#pragma once

#include "jobs/store/sqlite.h"

namespace toile {

// Takes all missing steps, each in its own transaction. Throws Error{StorageFailed} for a database of a newer Toile.
void migrate(Connection& connection);

}  // namespace toile
