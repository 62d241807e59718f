// SPDX-License-Identifier: GPL-3.0-or-later
// The workers of one process: some threads that run jobs, each in its own child process, and one that keeps the leases.
#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <thread>

#include "jobs/worker/attempt.h"

namespace toile {

struct WorkerPoolOptions {
  int workers = 1;  // jobs at a time, >= 1
  AttemptOptions attempt;
  std::int64_t heartbeat_ms = 5000;  // between renewals of the leases; far below QueueOptions::lease_ms
  std::int64_t lease_ms = 30000;     // as QueueOptions: without a renewal for so long a job is given up
  std::int64_t drain_ms = 25000;     // what running jobs may still take after drain() before they go back to the queue
};

// One line of the log: an event's name and its JSON details.
using EventLog = std::function<void(const std::string& event, const std::map<std::string, std::string>& details)>;

class WorkerPool {
 public:
  WorkerPool(Store& store, WorkerPoolOptions options, EventLog log);
  ~WorkerPool();  // drains
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  // Takes no new jobs, lets the running ones end or gives them back; answers when all is done.
  void drain();

 private:
  void work();
  void keep_leases();
  void run(const Job& job);
  void report_progress(bool all);
  void look_for_changes();
  std::vector<std::shared_ptr<AttemptState>> running() const;

  Store& store_;
  const WorkerPoolOptions options_;
  const EventLog log_;
  const std::string name_;
  int alive_lock_ = -1;

  mutable std::mutex lock_;
  std::condition_variable changed_;
  std::uint64_t announced_ = 0;  // times that work was announced
  bool draining_ = false;
  bool stopped_ = false;
  std::list<std::shared_ptr<AttemptState>> running_;
  std::map<std::string, ProgressReport> reported_;
  std::chrono::steady_clock::time_point renewed_;
  std::vector<std::thread> workers_;
  std::thread keeper_;
};

}  // namespace toile
