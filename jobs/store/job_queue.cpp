// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/job_queue.h"

#include <algorithm>

#include "engine/core/content_hash.h"
#include "jobs/store/identifier.h"
#include "jobs/store/job_reader.h"
#include "jobs/store/json_text.h"

namespace toile {

namespace {

// What makes two jobs equal: the same work on the same bytes by the same engine.
std::string identity_of(Transaction& transaction, const NewJob& job, const std::string& engine_version) {
  ContentHash hash;
  hash.add(std::string_view(engine_version)).add(std::string_view(job.kind)).add(std::string_view(job.options));
  for (const auto& [role, id] : job.inputs) {
    Statement row = transaction->query("SELECT identity FROM inputs WHERE id = ? AND tenant = ?", id, job.tenant);
    if (!row.step()) throw Error(ErrorCode::NotFound, "/" + role, "no " + role + " with this id: upload it first");
    const std::string identity = row.text(0);
    hash.add(std::string_view(role)).add(std::string_view(identity));
  }
  return hash.hex();
}

void refuse_when_full(Transaction& transaction, std::int64_t limit) {
  Statement row = transaction->query("SELECT count FROM waiting");
  if (row.step() && row.integer(0) >= limit)
    throw Error(ErrorCode::QueueFull, "queue", "too many jobs are waiting: try again later");
}

std::optional<std::string> succeeded_twin(Transaction& transaction, const NewJob& job, const std::string& identity) {
  Statement row = transaction->query(
      "SELECT id FROM jobs WHERE tenant = ? AND identity = ? AND state = 'succeeded' ORDER BY seq DESC LIMIT 1",
      job.tenant, identity);
  return row.step() ? std::optional(row.text(0)) : std::nullopt;
}

void tell_webhook(Transaction& transaction, const std::string& job, std::int64_t now) {
  transaction->run(
      "INSERT INTO webhooks(id, job_id, url, next_ms) SELECT ?, id, webhook, ? FROM jobs"
      " WHERE id = ? AND webhook IS NOT NULL",
      random_identifier("msg"), now, job);
}

// The job takes over the results of `twin` and is done.
void copy_results(Transaction& transaction, const std::string& job, const std::string& twin, std::int64_t now) {
  transaction->run(
      "UPDATE jobs SET state = 'succeeded', progress = 1, started_ms = ?1, finished_ms = ?1,"
      " summary = (SELECT summary FROM jobs WHERE id = ?3), timings = (SELECT timings FROM jobs WHERE id = ?3)"
      " WHERE id = ?2",
      now, job, twin);
  transaction->run("INSERT INTO artifacts SELECT ?1, name, content_type, sha256, size FROM artifacts WHERE job_id = ?2",
                   job, twin);
  tell_webhook(transaction, job, now);
}

bool is_held(Transaction& transaction, const Lease& lease) {
  Statement row = transaction->query("SELECT 1 FROM jobs WHERE id = ? AND attempt = ? AND state = 'running'", lease.job,
                                     lease.attempt);
  return row.step();
}

}  // namespace

JobQueue::JobQueue(Database& database, ArtifactStore& artifacts, Clock clock, QueueOptions options)
    : database_(database), artifacts_(artifacts), clock_(std::move(clock)), options_(std::move(options)) {}

std::string JobQueue::enqueue(Transaction& transaction, const NewJob& job) {
  const std::string identity = identity_of(transaction, job, options_.engine_version);
  const std::optional<std::string> twin = succeeded_twin(transaction, job, identity);
  if (!twin) refuse_when_full(transaction, options_.max_queued);
  const std::string id = random_identifier("job");
  const std::int64_t now = clock_();
  transaction->run(
      "INSERT INTO jobs(id, tenant, kind, identity, priority, state, options, labels, webhook, batch_id, blocked_by,"
      " created_ms) VALUES (?, ?, ?, ?, ?, 'queued', ?, ?, ?, ?, ?, ?)",
      id, job.tenant, job.kind, identity, static_cast<int>(job.priority), job.options, json_of_words(job.labels),
      job.webhook, job.batch, job.blocked_by, now);
  for (const auto& [role, input] : job.inputs)
    transaction->run("INSERT INTO job_inputs(job_id, role, input_id) VALUES (?, ?, ?)", id, role, input);
  if (twin) copy_results(transaction, id, *twin, now);
  return id;
}

bool JobQueue::is_ended(Transaction& transaction, const std::string& job) {
  Statement row = transaction->query("SELECT 1 FROM jobs WHERE id = ? AND finished_ms IS NOT NULL", job);
  return row.step();
}

std::optional<std::string> JobQueue::next_ready(Transaction& transaction, std::int64_t now) {
  transaction->run("UPDATE claims SET count = count + 1");
  std::int64_t count = 0;
  {
    Statement row = transaction->query("SELECT count FROM claims");
    row.step();
    count = row.integer(0);
  }
  // Every so often the batch class comes first, so that a steady stream of interactive jobs cannot starve it.
  const int first = count % options_.batch_share == 0 ? 1 : 0;
  for (const int priority : {first, 1 - first}) {
    Statement row = transaction->query(
        "SELECT id FROM jobs WHERE state = 'queued' AND blocked_by IS NULL AND priority = ? AND run_after_ms <= ?"
        " ORDER BY seq LIMIT 1",
        priority, now);
    if (row.step()) return row.text(0);
  }
  return std::nullopt;
}

std::optional<Job> JobQueue::claim(const std::string& worker) {
  const std::int64_t now = clock_();
  {
    // A look without the writer's lock: idle workers do not write.
    Reader reader(database_);
    Statement row = reader->query(
        "SELECT 1 FROM jobs WHERE state = 'queued' AND blocked_by IS NULL AND priority IN (0, 1) AND run_after_ms <= ?"
        " LIMIT 1",
        now);
    if (!row.step()) return std::nullopt;
  }
  Transaction transaction(database_, Durability::Eventually);
  const std::optional<std::string> id = next_ready(transaction, now);
  if (!id) return std::nullopt;
  transaction->run(
      "UPDATE jobs SET state = 'running', attempt = attempt + 1, version = version + 1, worker = ?,"
      " lease_until_ms = ?, started_ms = coalesce(started_ms, ?), stage = '', progress = 0 WHERE id = ?",
      worker, now + options_.lease_ms, now, *id);
  Job job;
  {
    Statement row = transaction->query((std::string("SELECT ") + kJobColumns + " FROM jobs WHERE id = ?").c_str(), *id);
    row.step();
    job = job_of_row(row);
  }
  read_job_inputs(*transaction, job);
  transaction.commit();
  return job;
}

std::vector<LeaseState> JobQueue::heartbeat(std::span<const ProgressReport> reports) {
  if (reports.empty()) return {};
  std::vector<LeaseState> states;
  const std::int64_t now = clock_();
  Transaction transaction(database_, Durability::Eventually);
  for (const ProgressReport& report : reports) {
    const std::int64_t renewed = transaction->run(
        "UPDATE jobs SET lease_until_ms = ?1, version = version + (stage <> ?2 OR progress < ?3), stage = ?2,"
        " progress = max(progress, ?3) WHERE id = ?4 AND attempt = ?5 AND state = 'running'",
        now + options_.lease_ms, report.stage, report.progress, report.lease.job, report.lease.attempt);
    states.push_back(renewed > 0 ? LeaseState::Held : LeaseState::Lost);
  }
  transaction.commit();
  return states;
}

std::vector<LeaseState> JobQueue::look(std::span<const Lease> leases) {
  std::vector<LeaseState> states;
  if (leases.empty()) return states;
  Reader reader(database_);
  for (const Lease& lease : leases) {
    Statement row =
        reader->query("SELECT cancel_requested FROM jobs WHERE id = ? AND attempt = ? AND state = 'running'", lease.job,
                      lease.attempt);
    if (!row.step())
      states.push_back(LeaseState::Lost);
    else
      states.push_back(row.integer(0) != 0 ? LeaseState::CancelRequested : LeaseState::Held);
  }
  return states;
}

void JobQueue::end(Transaction& transaction, const std::string& job, JobState state, const Outcome& outcome) {
  const std::int64_t now = clock_();
  const JobError error = outcome.error.value_or(JobError{});
  const auto column = [&](const std::string& value) { return outcome.error ? std::optional(value) : std::nullopt; };
  const bool done = state == JobState::Succeeded;
  transaction->run(
      "UPDATE jobs SET state = ?, version = version + 1, lease_until_ms = NULL, worker = NULL, finished_ms = ?,"
      " stage = '', progress = iif(?, 1.0, progress), error_code = ?, error_subject = ?, error_message = ?,"
      " summary = ?, timings = ? WHERE id = ?",
      std::string(state_name(state)), now, done, column(error.code), column(error.subject), column(error.message),
      done ? std::optional(outcome.summary) : std::nullopt, done ? std::optional(outcome.timings) : std::nullopt, job);
  transaction->run("UPDATE jobs SET blocked_by = NULL WHERE blocked_by = ?", job);
  tell_webhook(transaction, job, now);
}

void JobQueue::fail_or_requeue(Transaction& transaction, const Lease& lease, const Outcome& outcome) {
  const bool crashed = outcome.kind == Outcome::Kind::Crashed;
  if (crashed) transaction->run("UPDATE jobs SET crashes = crashes + 1 WHERE id = ?", lease.job);
  int crashes = 0;
  bool cancel = false;
  {
    Statement row = transaction->query("SELECT crashes, cancel_requested FROM jobs WHERE id = ?", lease.job);
    row.step();
    crashes = static_cast<int>(row.integer(0));
    cancel = row.integer(1) != 0;
  }
  if (cancel) return end(transaction, lease.job, JobState::Cancelled, {});
  if ((crashed && crashes >= options_.max_crashes) || lease.attempt >= options_.max_attempts)
    return end(transaction, lease.job, JobState::Failed, outcome);
  std::int64_t wait = 0;
  if (outcome.kind != Outcome::Kind::Interrupted)
    wait = std::min(options_.max_backoff_ms, options_.first_backoff_ms << std::min(lease.attempt - 1, 16));
  transaction->run(
      "UPDATE jobs SET state = 'queued', version = version + 1, lease_until_ms = NULL, worker = NULL, stage = '',"
      " progress = 0, run_after_ms = ? WHERE id = ?",
      clock_() + wait, lease.job);
}

bool JobQueue::finish(const Lease& lease, const Outcome& outcome) {
  {
    Transaction transaction(database_);
    if (!is_held(transaction, lease)) return false;
    switch (outcome.kind) {
      case Outcome::Kind::Succeeded:
        for (const NewArtifact& artifact : outcome.artifacts) {
          artifacts_.adopt(transaction, artifact.blob);
          transaction->run("INSERT INTO artifacts(job_id, name, content_type, sha256, size) VALUES (?, ?, ?, ?, ?)",
                           lease.job, artifact.name, artifact.content_type, artifact.blob.sha256(),
                           artifact.blob.size());
        }
        end(transaction, lease.job, JobState::Succeeded, outcome);
        break;
      case Outcome::Kind::Failed: end(transaction, lease.job, JobState::Failed, outcome); break;
      case Outcome::Kind::Cancelled: end(transaction, lease.job, JobState::Cancelled, {}); break;
      case Outcome::Kind::Crashed:
      case Outcome::Kind::Transient:
      case Outcome::Kind::Interrupted: fail_or_requeue(transaction, lease, outcome); break;
    }
    transaction.commit();
  }
  announce_work();
  return true;
}

bool JobQueue::cancel(const std::string& tenant, const std::string& job) {
  {
    Transaction transaction(database_);
    std::string state;
    {
      Statement row = transaction->query("SELECT state FROM jobs WHERE id = ? AND tenant = ?", job, tenant);
      if (!row.step()) throw Error(ErrorCode::NotFound, "job", "no job with this id");
      state = row.text(0);
    }
    if (state == "queued")
      end(transaction, job, JobState::Cancelled, {});
    else if (state == "running")
      transaction->run("UPDATE jobs SET cancel_requested = 1, version = version + 1 WHERE id = ?", job);
    else
      return false;
    transaction.commit();
  }
  announce_work();
  return true;
}

int JobQueue::give_back(const std::vector<Lease>& leases) {
  Outcome outcome;
  outcome.kind = Outcome::Kind::Interrupted;
  outcome.error = JobError{std::string(error_name(ErrorCode::Crashed)), "worker",
                           "its workers were killed again and again: is the machine short of memory?"};
  int given = 0;
  for (const Lease& lease : leases) given += finish(lease, outcome) ? 1 : 0;
  return given;
}

int JobQueue::recover_expired() {
  std::vector<Lease> expired;
  {
    Reader reader(database_);
    Statement rows =
        reader->query("SELECT id, attempt FROM jobs WHERE state = 'running' AND lease_until_ms < ?", clock_());
    while (rows.step()) expired.push_back({rows.text(0), static_cast<int>(rows.integer(1))});
  }
  return give_back(expired);
}

int JobQueue::give_back_jobs_of(const std::string& worker) {
  std::vector<Lease> orphaned;
  {
    Reader reader(database_);
    Statement rows = reader->query("SELECT id, attempt FROM jobs WHERE state = 'running' AND worker = ?", worker);
    while (rows.step()) orphaned.push_back({rows.text(0), static_cast<int>(rows.integer(1))});
  }
  return give_back(orphaned);
}

}  // namespace toile
