// SPDX-License-Identifier: GPL-3.0-or-later
// Housekeeping of a data folder: retention, stages too old or too many, leftovers of killed processes, the log.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "jobs/store/store.h"
#include "jobs/worker/worker_pool.h"

namespace toile {

struct SweepOptions {
  int retention_days = 30;                   // ended jobs and unused inputs older than this go; 0: never
  std::int64_t stage_bytes = 4LL << 30;      // finished stages kept in all
  std::int64_t orphan_age_ms = 3600 * 1000;  // files without a row this old are leftovers, not uploads under way
  std::int64_t idempotency_ms = 86400 * 1000;
  std::int64_t every_ms = 600 * 1000;  // between sweeps
};

// One sweep. Working folders of attempts that are not running go as well.
void sweep(Store& store, const SweepOptions& options);

// Sweeps at once and then regularly, in a thread of its own. Failures are logged, the next sweep tries again.
class Sweeper {
 public:
  Sweeper(Store& store, SweepOptions options, EventLog log);
  ~Sweeper();
  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;

 private:
  std::mutex lock_;
  std::condition_variable stop_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace toile
