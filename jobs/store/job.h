// SPDX-License-Identifier: GPL-3.0-or-later
// What the queue knows about a job. Documents (options, labels, summary, timings) are kept as JSON text.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace toile {

enum class JobState { Queued, Running, Succeeded, Failed, Cancelled };
std::string_view state_name(JobState state);
JobState state_of_name(std::string_view name);
inline bool is_final(JobState state) {
  return state != JobState::Queued && state != JobState::Running;
}

enum class Priority { Interactive = 0, Batch = 1 };

struct JobError {
  std::string code;  // of error_name()
  std::string subject;
  std::string message;
};

// A job as it is handed in.
struct NewJob {
  std::string tenant;
  std::string kind;
  std::map<std::string, std::string> inputs;  // role (garment, worn, reference_body, target_body) -> id
  std::string options = "{}";                 // JSON object
  std::vector<std::string> labels;
  std::optional<std::string> webhook;  // URL told of the end
  Priority priority = Priority::Interactive;
  std::optional<std::string> batch;
  std::optional<std::string> blocked_by;  // job that must end first, because it makes what this one reuses
};

struct Job {
  std::int64_t sequence = 0;  // order of arrival
  std::string id;
  std::string tenant;
  std::string kind;
  JobState state = JobState::Queued;
  int attempt = 0;  // fencing token: number of the current or last lease
  int crashes = 0;  // times its process ended by a fault of its own
  int version = 1;  // grows with every change
  bool cancel_requested = false;
  std::string stage;      // name of the running stage, or empty
  double progress = 0.0;  // 0..1 of the whole job
  std::map<std::string, std::string> inputs;
  std::string options;
  std::vector<std::string> labels;
  std::optional<std::string> batch;
  std::int64_t created_ms = 0;
  std::optional<std::int64_t> started_ms;
  std::optional<std::int64_t> finished_ms;
  std::optional<JobError> error;
  std::optional<std::string> summary;  // JSON: quality, alterations in short, fit by zone
  std::optional<std::string> timings;  // JSON
};

struct ArtifactRecord {
  std::string name;
  std::string content_type;
  std::string sha256;
  std::int64_t size = 0;
};

}  // namespace toile
