// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/removal.h"

#include <chrono>
#include <thread>

namespace toile {

namespace {

constexpr int kJobsPerTransaction = 100;                       // bounds how long the writer's lock is held
constexpr std::int64_t kRewriteAfterAgeMs = 24 * 3600 * 1000;  // what goes by age may leave traces for a day

template <class... Values>
std::vector<std::string> column(Connection& connection, const char* sql, const Values&... values) {
  std::vector<std::string> list;
  Statement rows = connection.query(sql, values...);
  while (rows.step()) list.push_back(rows.text(0));
  return list;
}

// Part of the removal's own transaction: a process that dies before the rewriting leaves it to the sweeper.
void ask_for_rewriting(Transaction& transaction, std::int64_t due_ms) {
  transaction->run(
      "UPDATE rewriting SET due_ms = CASE WHEN asked = done THEN ?1 ELSE min(due_ms, ?1) END, asked = asked + 1",
      due_ms);
}

}  // namespace

Removal::Removal(Database& database, ArtifactStore& artifacts, Clock clock)
    : database_(database), artifacts_(artifacts), clock_(std::move(clock)) {}

void Removal::remove_job(Transaction& transaction, const std::string& id) {
  const auto blobs = column(*transaction, "SELECT sha256 FROM artifacts WHERE job_id = ?", id);
  transaction->run("UPDATE jobs SET blocked_by = NULL WHERE blocked_by = ?", id);
  transaction->run("DELETE FROM idempotency WHERE resource = ?", id);
  transaction->run("DELETE FROM jobs WHERE id = ?", id);
  for (const std::string& blob : blobs) artifacts_.release(transaction, blob);
}

RemovalCounts Removal::remove_input_rows(Transaction& transaction, const std::string& id) {
  RemovalCounts counts;
  const auto jobs = column(*transaction, "SELECT DISTINCT job_id FROM job_inputs WHERE input_id = ?", id);
  for (const std::string& job : jobs) remove_job(transaction, job);
  const auto batches = column(*transaction, "SELECT id FROM batches WHERE garment = ?1 OR reference_body = ?1", id);
  for (const std::string& batch : batches) {
    transaction->run("DELETE FROM idempotency WHERE resource = ?", batch);
    transaction->run("DELETE FROM batches WHERE id = ?", batch);
  }
  const auto stages = column(*transaction, "SELECT key FROM stage_sources WHERE input_id = ?", id);
  for (const std::string& key : stages) {
    const auto blobs = column(*transaction, "SELECT sha256 FROM stages WHERE key = ?", key);
    transaction->run("DELETE FROM stages WHERE key = ?", key);
    for (const std::string& blob : blobs) artifacts_.release(transaction, blob);
  }
  const auto blobs = column(*transaction, "SELECT sha256 FROM inputs WHERE id = ?", id);
  transaction->run("DELETE FROM idempotency WHERE resource = ?", id);
  counts.inputs = static_cast<int>(transaction->run("DELETE FROM inputs WHERE id = ?", id));
  for (const std::string& blob : blobs) artifacts_.release(transaction, blob);
  counts.jobs = static_cast<int>(jobs.size());
  counts.stages = static_cast<int>(stages.size());
  return counts;
}

RemovalCounts Removal::remove_input(const std::string& tenant, InputKind kind, const std::string& id) {
  RemovalCounts counts;
  {
    Transaction transaction(database_);
    const auto found = column(*transaction, "SELECT id FROM inputs WHERE tenant = ? AND kind = ? AND id = ?", tenant,
                              kind_name(kind), id);
    if (found.empty())
      throw Error(ErrorCode::NotFound, std::string(kind_name(kind)),
                  "no " + std::string(kind_name(kind)) + " with this id");
    counts = remove_input_rows(transaction, id);
    ask_for_rewriting(transaction, clock_());
    transaction.commit();
  }
  wipe();
  return counts;
}

RemovalCounts Removal::remove_older_than(std::int64_t before_ms) {
  RemovalCounts counts;
  const auto old_jobs = [&](Connection& connection) {
    return column(connection, "SELECT id FROM jobs WHERE finished_ms < ? ORDER BY finished_ms LIMIT ?", before_ms,
                  kJobsPerTransaction);
  };
  for (;;) {
    Transaction transaction(database_);
    const auto jobs = old_jobs(*transaction);
    if (jobs.empty()) break;
    for (const std::string& job : jobs) remove_job(transaction, job);
    ask_for_rewriting(transaction, clock_() + kRewriteAfterAgeMs);
    transaction.commit();
    counts.jobs += static_cast<int>(jobs.size());
  }
  {
    Transaction transaction(database_);
    transaction->run(
        "DELETE FROM batches WHERE created_ms < ? AND NOT EXISTS (SELECT 1 FROM jobs WHERE batch_id = batches.id)",
        before_ms);
    const auto inputs =
        column(*transaction,
               "SELECT id FROM inputs WHERE created_ms < ? AND id NOT IN (SELECT input_id FROM input_labels)"
               " AND id NOT IN (SELECT input_id FROM job_inputs) AND id NOT IN (SELECT garment FROM batches)"
               " AND id NOT IN (SELECT reference_body FROM batches WHERE reference_body IS NOT NULL)",
               before_ms);
    for (const std::string& input : inputs) {
      counts.stages += remove_input_rows(transaction, input).stages;
      ++counts.inputs;
    }
    if (!inputs.empty()) ask_for_rewriting(transaction, clock_() + kRewriteAfterAgeMs);
    transaction.commit();
  }
  return counts;
}

void Removal::forget_idempotency(std::int64_t before_ms) {
  Transaction transaction(database_);
  transaction->run("DELETE FROM idempotency WHERE created_ms < ?", before_ms);
  transaction.commit();
}

void Removal::wipe() {
  artifacts_.empty_trash();
  const std::optional<std::int64_t> asked = due_rewriting();
  if (asked) database_.rewrite();
  if (!empty_log() || !asked) return;
  Transaction transaction(database_);
  transaction->run("UPDATE rewriting SET done = max(done, ?)", *asked);
  transaction.commit();
}

// The removals asked for so far, if rewriting for one of them is due.
std::optional<std::int64_t> Removal::due_rewriting() {
  Reader reader(database_);
  Statement row = reader->query("SELECT asked FROM rewriting WHERE asked > done AND due_ms <= ?", clock_());
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

bool Removal::empty_log() {
  // Readers end within milliseconds; the log still holds pages as they were before the deletion.
  for (int attempt = 0; attempt < 50; ++attempt) {
    if (database_.empty_log()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

}  // namespace toile
