// SPDX-License-Identifier: GPL-3.0-or-later
// Taking things away for good: on request, and by age. Files are removed, the database is rewritten from the rows that
// stay, the log is emptied: afterwards no byte of what was deleted is left in the data folder.
#pragma once

#include <optional>

#include "jobs/store/artifact_store.h"
#include "jobs/store/input_store.h"

namespace toile {

struct RemovalCounts {
  int jobs = 0;
  int inputs = 0;
  int stages = 0;
};

class Removal {
 public:
  Removal(Database& database, ArtifactStore& artifacts, Clock clock);

  // The input, the jobs that use it (running ones lose their lease), their artifacts, the stages made from it.
  // Throws Error{NotFound}.
  RemovalCounts remove_input(const std::string& tenant, InputKind kind, const std::string& id);
  // Jobs that ended before `before_ms`; then inputs from before it without label that no job uses.
  RemovalCounts remove_older_than(std::int64_t before_ms);
  // Forgets Idempotency-Keys from before `before_ms`.
  void forget_idempotency(std::int64_t before_ms);
  // Clears the traces of removals: at once of those on request, within a day of those by age; also of those whose
  // process died or whose disk was full meanwhile. The sweeper calls it.
  void wipe();

 private:
  void remove_job(Transaction& transaction, const std::string& id);
  RemovalCounts remove_input_rows(Transaction& transaction, const std::string& id);
  std::optional<std::int64_t> due_rewriting();
  bool empty_log();

  Database& database_;
  ArtifactStore& artifacts_;
  Clock clock_;
};

}  // namespace toile
