// SPDX-License-Identifier: GPL-3.0-or-later
// The queue: at least once, fenced by the attempt number. A worker holds a job by a lease it must renew; one that lost
// its lease can no longer change the job. State diagram in jobs/README.md.
#pragma once

#include <functional>
#include <span>

#include "jobs/store/artifact_store.h"
#include "jobs/store/job.h"

namespace toile {

struct QueueOptions {
  std::int64_t lease_ms = 30000;         // a worker silent for so long has lost its job, > 0
  int max_crashes = 2;                   // crashes after which a job fails as `crashed`, >= 1
  int max_attempts = 16;                 // leases of one job, lost ones included, after which it fails, >= 1
  std::int64_t first_backoff_ms = 1000;  // wait before the second try; doubled for each further one
  std::int64_t max_backoff_ms = 60000;   // bound of that wait
  int batch_share = 8;                   // one claim in so many looks at batch jobs first, >= 2
  std::int64_t max_queued = 10000;       // waiting jobs beyond which QueueFull is answered
  std::string engine_version = "0";      // part of a job's identity: results of another engine are not reused
};

// The right to work on a job.
struct Lease {
  std::string job;
  int attempt = 0;
};

struct ProgressReport {
  Lease lease;
  std::string stage;
  double progress = 0.0;
};

enum class LeaseState { Held, CancelRequested, Lost };

// A file a job made.
struct NewArtifact {
  std::string name;
  std::string content_type;
  PreparedBlob blob;
};

// How an attempt ended.
struct Outcome {
  enum class Kind {
    Succeeded,
    Failed,       // the computation said so: for good
    Cancelled,    // asked for
    Crashed,      // ended by a fault of its own: tried again until max_crashes
    Transient,    // full disk and the like: tried again after a wait, until max_attempts
    Interrupted,  // killed from outside or given back on shutdown: tried again at once, until max_attempts
  } kind = Kind::Succeeded;
  std::optional<JobError> error;
  std::vector<NewArtifact> artifacts;  // published already
  std::string summary = "{}";
  std::string timings = "{}";
};

class JobQueue {
 public:
  JobQueue(Database& database, ArtifactStore& artifacts, Clock clock, QueueOptions options);

  // A fresh job, or, when an equal one has succeeded before, a finished one with the same artifacts.
  // Throws Error{QueueFull}; Error{NotFound} with subject "/<role>" for an input the tenant does not own.
  std::string enqueue(Transaction& transaction, const NewJob& job);

  // Whether a job of this transaction has ended already, by reuse of known results.
  static bool is_ended(Transaction& transaction, const std::string& job);

  // The next job in line, leased to `worker`; nothing when none is due.
  std::optional<Job> claim(const std::string& worker);
  // Renews leases and stores progress; one answer per report.
  std::vector<LeaseState> heartbeat(std::span<const ProgressReport> reports);
  // Leases whose job is asked to cancel or no longer theirs; does not write.
  std::vector<LeaseState> look(std::span<const Lease> leases);
  // Ends the attempt. False when the lease was lost: nothing has changed then.
  bool finish(const Lease& lease, const Outcome& outcome);

  // Asks a queued or running job to end. False when it has ended already; Error{NotFound}.
  bool cancel(const std::string& tenant, const std::string& job);
  // Puts back the jobs of workers that fell silent; answers how many.
  int recover_expired();
  // The same, at once, for a worker known to be dead.
  int give_back_jobs_of(const std::string& worker);

  // Called after each commit that may give an idle worker something to do.
  void on_work(std::function<void()> listener) { on_work_ = std::move(listener); }
  void announce_work() const {
    if (on_work_) on_work_();
  }

 private:
  int give_back(const std::vector<Lease>& leases);
  void fail_or_requeue(Transaction& transaction, const Lease& lease, const Outcome& outcome);
  void end(Transaction& transaction, const std::string& job, JobState state, const Outcome& outcome);
  std::optional<std::string> next_ready(Transaction& transaction, std::int64_t now);

  Database& database_;
  ArtifactStore& artifacts_;
  Clock clock_;
  QueueOptions options_;
  std::function<void()> on_work_;
};

}  // namespace toile
