// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/migrations.h"

#include <array>

#include "engine/core/error.h"

namespace toile {

namespace {

// Steps are append-only: a database in the field has taken them already.
constexpr std::array kSteps = {
    R"sql(
CREATE TABLE blobs(
  sha256 TEXT PRIMARY KEY, size INTEGER NOT NULL, created_ms INTEGER NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE trash(sha256 TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;

CREATE TABLE inputs(
  seq INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, tenant TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('body', 'garment')),
  identity TEXT NOT NULL, name TEXT NOT NULL, fields TEXT NOT NULL, about TEXT NOT NULL,
  sha256 TEXT NOT NULL REFERENCES blobs, size INTEGER NOT NULL, created_ms INTEGER NOT NULL,
  UNIQUE (tenant, kind, identity)) STRICT;
CREATE INDEX inputs_by_blob ON inputs(sha256);
CREATE TABLE input_labels(
  input_id TEXT NOT NULL REFERENCES inputs(id) ON DELETE CASCADE, label TEXT NOT NULL,
  PRIMARY KEY (input_id, label)) STRICT, WITHOUT ROWID;
CREATE INDEX input_labels_by_label ON input_labels(label);

CREATE TABLE batches(
  seq INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, tenant TEXT NOT NULL, options TEXT NOT NULL,
  labels TEXT NOT NULL, garment TEXT NOT NULL REFERENCES inputs(id), reference_body TEXT REFERENCES inputs(id),
  created_ms INTEGER NOT NULL) STRICT;
CREATE INDEX batches_by_garment ON batches(garment);
CREATE INDEX batches_by_body ON batches(reference_body);

CREATE TABLE jobs(
  seq INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, tenant TEXT NOT NULL, kind TEXT NOT NULL,
  identity TEXT NOT NULL, priority INTEGER NOT NULL CHECK (priority IN (0, 1)),
  state TEXT NOT NULL CHECK (state IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
  attempt INTEGER NOT NULL DEFAULT 0, crashes INTEGER NOT NULL DEFAULT 0, version INTEGER NOT NULL DEFAULT 1,
  run_after_ms INTEGER NOT NULL DEFAULT 0, lease_until_ms INTEGER, worker TEXT,
  cancel_requested INTEGER NOT NULL DEFAULT 0, stage TEXT NOT NULL DEFAULT '', progress REAL NOT NULL DEFAULT 0,
  options TEXT NOT NULL, labels TEXT NOT NULL, webhook TEXT, batch_id TEXT REFERENCES batches(id) ON DELETE CASCADE,
  blocked_by TEXT, created_ms INTEGER NOT NULL, started_ms INTEGER, finished_ms INTEGER,
  error_code TEXT, error_subject TEXT, error_message TEXT, summary TEXT, timings TEXT,
  CHECK ((state = 'running') = (lease_until_ms IS NOT NULL)),
  CHECK ((state IN ('succeeded', 'failed', 'cancelled')) = (finished_ms IS NOT NULL))) STRICT;
CREATE INDEX jobs_ready ON jobs(priority, seq) WHERE state = 'queued' AND blocked_by IS NULL;
CREATE INDEX jobs_running ON jobs(lease_until_ms) WHERE state = 'running';
CREATE INDEX jobs_by_state ON jobs(state);
CREATE INDEX jobs_by_tenant ON jobs(tenant, seq);
CREATE INDEX jobs_by_identity ON jobs(tenant, identity) WHERE state = 'succeeded';
CREATE INDEX jobs_by_batch ON jobs(batch_id) WHERE batch_id IS NOT NULL;
CREATE INDEX jobs_by_leader ON jobs(blocked_by) WHERE blocked_by IS NOT NULL;
CREATE INDEX jobs_by_end ON jobs(finished_ms) WHERE finished_ms IS NOT NULL;
CREATE TABLE job_inputs(
  job_id TEXT NOT NULL REFERENCES jobs(id) ON DELETE CASCADE, role TEXT NOT NULL,
  input_id TEXT NOT NULL REFERENCES inputs(id), PRIMARY KEY (job_id, role)) STRICT, WITHOUT ROWID;
CREATE INDEX job_inputs_by_input ON job_inputs(input_id);
CREATE TABLE artifacts(
  job_id TEXT NOT NULL REFERENCES jobs(id) ON DELETE CASCADE, name TEXT NOT NULL, content_type TEXT NOT NULL,
  sha256 TEXT NOT NULL REFERENCES blobs, size INTEGER NOT NULL, PRIMARY KEY (job_id, name)) STRICT, WITHOUT ROWID;
CREATE INDEX artifacts_by_blob ON artifacts(sha256);
CREATE TABLE claims(only INTEGER PRIMARY KEY CHECK (only = 1), count INTEGER NOT NULL) STRICT;
INSERT INTO claims VALUES (1, 0);

CREATE TABLE stages(
  key TEXT PRIMARY KEY, sha256 TEXT NOT NULL REFERENCES blobs, size INTEGER NOT NULL,
  used_ms INTEGER NOT NULL) STRICT, WITHOUT ROWID;
CREATE INDEX stages_by_blob ON stages(sha256);
CREATE INDEX stages_by_use ON stages(used_ms);
CREATE TABLE stage_sources(
  key TEXT NOT NULL REFERENCES stages ON DELETE CASCADE, input_id TEXT NOT NULL REFERENCES inputs(id),
  PRIMARY KEY (key, input_id)) STRICT, WITHOUT ROWID;
CREATE INDEX stage_sources_by_input ON stage_sources(input_id);

CREATE TABLE idempotency(
  tenant TEXT NOT NULL, key TEXT NOT NULL, request_hash TEXT NOT NULL, status INTEGER NOT NULL,
  resource TEXT NOT NULL, created_ms INTEGER NOT NULL, PRIMARY KEY (tenant, key)) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_by_age ON idempotency(created_ms);
CREATE INDEX idempotency_by_resource ON idempotency(resource);

CREATE TABLE webhooks(
  seq INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, job_id TEXT NOT NULL REFERENCES jobs(id) ON DELETE CASCADE,
  url TEXT NOT NULL, attempt INTEGER NOT NULL DEFAULT 0, next_ms INTEGER NOT NULL) STRICT;
CREATE INDEX webhooks_by_job ON webhooks(job_id);
CREATE INDEX webhooks_by_time ON webhooks(next_ms);

CREATE TABLE workers(
  name TEXT PRIMARY KEY, seen_ms INTEGER NOT NULL, slots INTEGER NOT NULL, running INTEGER NOT NULL) STRICT, WITHOUT ROWID;
)sql",
    // The number of queued jobs, so that handing in a job does not count them all.
    R"sql(
CREATE TABLE waiting(only INTEGER PRIMARY KEY CHECK (only = 1), count INTEGER NOT NULL) STRICT;
INSERT INTO waiting SELECT 1, count(*) FROM jobs WHERE state = 'queued';
CREATE TRIGGER jobs_come AFTER INSERT ON jobs WHEN NEW.state = 'queued'
  BEGIN UPDATE waiting SET count = count + 1; END;
CREATE TRIGGER jobs_return AFTER UPDATE OF state ON jobs WHEN NEW.state = 'queued' AND OLD.state <> 'queued'
  BEGIN UPDATE waiting SET count = count + 1; END;
CREATE TRIGGER jobs_leave AFTER UPDATE OF state ON jobs WHEN OLD.state = 'queued' AND NEW.state <> 'queued'
  BEGIN UPDATE waiting SET count = count - 1; END;
CREATE TRIGGER jobs_go AFTER DELETE ON jobs WHEN OLD.state = 'queued'
  BEGIN UPDATE waiting SET count = count - 1; END;
)sql",
    // Removals after which the database is still to be rewritten, and by when. Older versions never did: once at first.
    R"sql(
CREATE TABLE rewriting(
  only INTEGER PRIMARY KEY CHECK (only = 1), asked INTEGER NOT NULL, done INTEGER NOT NULL, due_ms INTEGER NOT NULL) STRICT;
INSERT INTO rewriting VALUES (1, 1, 0, 0);
)sql",
};

}  // namespace

void migrate(Connection& connection) {
  const auto taken = [&] {
    Statement rows = connection.query("PRAGMA user_version");
    rows.step();
    return rows.integer(0);
  };
  if (taken() > static_cast<std::int64_t>(kSteps.size()))
    throw Error(ErrorCode::StorageFailed, "database",
                "the data folder was written by a newer version of Toile: use that version, or another --data");
  for (std::size_t step = 0; step < kSteps.size(); ++step) {
    if (taken() > static_cast<std::int64_t>(step)) continue;
    connection.run_script("BEGIN IMMEDIATE");
    try {
      // Another process may have taken the step while this one waited for the lock.
      if (taken() == static_cast<std::int64_t>(step))
        connection.run_script(kSteps[step] + ("PRAGMA user_version=" + std::to_string(step + 1)));
      connection.run_script("COMMIT");
    } catch (...) {
      try {
        connection.run_script("ROLLBACK");
      } catch (...) {
        // Already rolled back by SQLite.
      }
      throw;
    }
  }
}

}  // namespace toile
