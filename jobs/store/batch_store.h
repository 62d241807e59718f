// SPDX-License-Identifier: GPL-3.0-or-later
// Batches: one garment, many bodies, one job each. The jobs carry the batch's id.
#pragma once

#include "jobs/store/clock.h"
#include "jobs/store/database.h"
#include "jobs/store/job.h"

namespace toile {

struct Batch {
  std::int64_t sequence = 0;
  std::string id;
  std::string tenant;
  std::string options;
  std::vector<std::string> labels;
  std::string garment;
  std::optional<std::string> reference_body;
  std::int64_t created_ms = 0;
};

// Stores a batch (id, sequence and time are given here); its jobs follow in the same transaction.
std::string add_batch(Transaction& transaction, const Batch& batch, std::int64_t now_ms);
std::optional<Batch> find_batch(Database& database, const std::string& tenant, const std::string& id);
std::vector<Batch> list_batches(Database& database, const std::string& tenant, std::int64_t before, int limit);
std::map<JobState, std::int64_t> count_batch_jobs(Database& database, const std::string& batch);

}  // namespace toile
