// SPDX-License-Identifier: GPL-3.0-or-later
// Looking at jobs; nothing here writes. A tenant sees only its own.
#pragma once

#include "jobs/store/database.h"
#include "jobs/store/job.h"

namespace toile {

struct JobFilter {
  std::optional<JobState> state;
  std::optional<std::string> label;
  std::optional<std::string> batch;
  std::int64_t before = 0;  // only jobs that arrived before this sequence number; 0: from the newest
  int limit = 50;
};

struct QueueCounts {
  std::map<JobState, std::int64_t> jobs;
  std::int64_t oldest_queued_ms = 0;  // arrival of the longest waiting job, 0 if none
};

class JobReader {
 public:
  explicit JobReader(Database& database) : database_(database) {}

  std::optional<Job> find(const std::string& tenant, const std::string& id) const;
  std::vector<Job> list(const std::string& tenant, const JobFilter& filter) const;  // newest first
  std::vector<ArtifactRecord> artifacts(const std::string& job) const;              // by name
  std::optional<ArtifactRecord> artifact(const std::string& job, const std::string& name) const;
  QueueCounts counts() const;

 private:
  Database& database_;
};

// Reads the columns that kJobColumns names, in their order.
extern const char* const kJobColumns;
Job job_of_row(const Statement& row);
// Fills `inputs`, which lie in a table of their own.
void read_job_inputs(Connection& connection, Job& job);

}  // namespace toile
