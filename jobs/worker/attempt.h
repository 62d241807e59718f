// SPDX-License-Identifier: GPL-3.0-or-later
// One attempt at one job: the worker's side of the child process.
#pragma once

#include <atomic>
#include <mutex>

#include "jobs/store/store.h"
#include "jobs/worker/child_process.h"

namespace toile {

struct AttemptOptions {
  std::vector<std::string> command;  // the program that calls run_job(), absolute
  ChildLimits limits;
  int wall_s = 7200;          // seconds a job may take in all, > 0
  int threads = 1;            // of one job
  int cancel_grace_ms = 600;  // between asking a job to end and killing it
};

// What the monitor thread and the attempt tell each other.
class AttemptState {
 public:
  explicit AttemptState(Lease lease) : lease_(std::move(lease)) {}

  const Lease& lease() const { return lease_; }
  void set_progress(const std::string& stage, double progress);
  ProgressReport progress() const;

  std::atomic<bool> cancel{false};     // the user asked for it
  std::atomic<bool> lost{false};       // another worker may have the job: end it and say nothing
  std::atomic<bool> give_back{false};  // this worker is shutting down

 private:
  const Lease lease_;
  mutable std::mutex lock_;
  std::string stage_;
  double progress_ = 0.0;
};

// Runs the job in a child process and reports how it ended. Published artifacts are part of the outcome.
// Throws Error{StorageFull, StorageFailed, ResourceLimit}: the attempt could not be made.
Outcome make_attempt(const Job& job, Store& store, const AttemptOptions& options, AttemptState& state);

}  // namespace toile
