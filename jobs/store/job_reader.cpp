// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/job_reader.h"

#include <array>

#include "jobs/store/json_text.h"

namespace toile {

namespace {

constexpr std::array<std::string_view, 5> kStateNames = {"queued", "running", "succeeded", "failed", "cancelled"};

#define TOILE_JOB_COLUMNS                                                                                         \
  "seq, id, tenant, kind, state, attempt, crashes, version, cancel_requested, stage, progress, options, labels, " \
  "batch_id, created_ms, started_ms, finished_ms, error_code, error_subject, error_message, summary, timings"

}  // namespace

const char* const kJobColumns = TOILE_JOB_COLUMNS;

std::string_view state_name(JobState state) {
  return kStateNames[static_cast<std::size_t>(state)];
}

JobState state_of_name(std::string_view name) {
  for (std::size_t i = 0; i < kStateNames.size(); ++i)
    if (kStateNames[i] == name) return static_cast<JobState>(i);
  throw Error(ErrorCode::OptionInvalid, "state", "unknown state; use queued, running, succeeded, failed or cancelled");
}

Job job_of_row(const Statement& row) {
  Job job;
  job.sequence = row.integer(0);
  job.id = row.text(1);
  job.tenant = row.text(2);
  job.kind = row.text(3);
  job.state = state_of_name(row.text(4));
  job.attempt = static_cast<int>(row.integer(5));
  job.crashes = static_cast<int>(row.integer(6));
  job.version = static_cast<int>(row.integer(7));
  job.cancel_requested = row.integer(8) != 0;
  job.stage = row.text(9);
  job.progress = row.real(10);
  job.options = row.text(11);
  job.labels = words_of_json(row.text(12));
  job.batch = row.optional_text(13);
  job.created_ms = row.integer(14);
  job.started_ms = row.optional_integer(15);
  job.finished_ms = row.optional_integer(16);
  if (!row.is_null(17)) job.error = JobError{row.text(17), row.text(18), row.text(19)};
  job.summary = row.optional_text(20);
  job.timings = row.optional_text(21);
  return job;
}

void read_job_inputs(Connection& connection, Job& job) {
  Statement rows = connection.query("SELECT role, input_id FROM job_inputs WHERE job_id = ?", job.id);
  while (rows.step()) job.inputs[rows.text(0)] = rows.text(1);
}

std::optional<Job> JobReader::find(const std::string& tenant, const std::string& id) const {
  Reader reader(database_);
  std::optional<Job> job;
  {
    Statement row = reader->query("SELECT " TOILE_JOB_COLUMNS " FROM jobs WHERE id = ? AND tenant = ?", id, tenant);
    if (row.step()) job = job_of_row(row);
  }
  if (job) read_job_inputs(*reader.operator->(), *job);
  return job;
}

std::vector<Job> JobReader::list(const std::string& tenant, const JobFilter& filter) const {
  Reader reader(database_);
  std::vector<Job> jobs;
  {
    const std::optional<std::string> state =
        filter.state ? std::optional(std::string(state_name(*filter.state))) : std::nullopt;
    Statement rows =
        reader->query("SELECT " TOILE_JOB_COLUMNS
                      " FROM jobs WHERE tenant = ?1 AND (?2 = 0 OR seq < ?2) AND (?3 IS NULL OR state = ?3)"
                      " AND (?4 IS NULL OR EXISTS (SELECT 1 FROM json_each(labels) WHERE value = ?4))"
                      " AND (?5 IS NULL OR batch_id = ?5) ORDER BY seq DESC LIMIT ?6",
                      tenant, filter.before, state, filter.label, filter.batch, filter.limit);
    while (rows.step()) jobs.push_back(job_of_row(rows));
  }
  for (Job& job : jobs) read_job_inputs(*reader.operator->(), job);
  return jobs;
}

std::vector<ArtifactRecord> JobReader::artifacts(const std::string& job) const {
  Reader reader(database_);
  std::vector<ArtifactRecord> list;
  Statement rows =
      reader->query("SELECT name, content_type, sha256, size FROM artifacts WHERE job_id = ? ORDER BY name", job);
  while (rows.step()) list.push_back({rows.text(0), rows.text(1), rows.text(2), rows.integer(3)});
  return list;
}

std::optional<ArtifactRecord> JobReader::artifact(const std::string& job, const std::string& name) const {
  Reader reader(database_);
  Statement row =
      reader->query("SELECT name, content_type, sha256, size FROM artifacts WHERE job_id = ? AND name = ?", job, name);
  if (!row.step()) return std::nullopt;
  return ArtifactRecord{row.text(0), row.text(1), row.text(2), row.integer(3)};
}

QueueCounts JobReader::counts() const {
  Reader reader(database_);
  QueueCounts counts;
  {
    Statement rows = reader->query("SELECT state, count(*) FROM jobs GROUP BY state");
    while (rows.step()) counts.jobs[state_of_name(rows.text(0))] = rows.integer(1);
  }
  Statement row = reader->query("SELECT min(created_ms) FROM jobs WHERE state = 'queued'");
  if (row.step()) counts.oldest_queued_ms = row.integer(0);
  return counts;
}

}  // namespace toile
