// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/sweeper.h"

namespace toile {

namespace {

constexpr std::int64_t kDayMs = 86400LL * 1000;

// A folder is named JOB-ATTEMPT; it is in use while that attempt holds the job.
bool is_in_use(Store& store, const std::string& name) {
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos) return false;
  Reader reader(store.database);
  Statement row = reader->query("SELECT 1 FROM jobs WHERE id = ? AND attempt = ? AND state = 'running'",
                                name.substr(0, dash), name.substr(dash + 1));
  return row.step();
}

void remove_unused_scratch(Store& store) {
  std::error_code error;
  // Folders of inspections have no job; they live for a minute at most, and their owners remove them.
  for (const auto& entry : std::filesystem::directory_iterator(store.scratch_folder(), error))
    if (entry.path().filename().string().starts_with("job_") && !is_in_use(store, entry.path().filename().string()))
      std::filesystem::remove_all(entry.path(), error);
}

}  // namespace

void sweep(Store& store, const SweepOptions& options) {
  const std::int64_t now = store.clock();
  if (options.retention_days > 0) store.removal.remove_older_than(now - options.retention_days * kDayMs);
  const std::int64_t stage_age = options.retention_days > 0 ? now - options.retention_days * kDayMs : 0;
  store.stages.evict(stage_age, options.stage_bytes);
  store.removal.forget_idempotency(now - options.idempotency_ms);
  store.removal.wipe();
  store.artifacts.remove_orphans(system_clock_ms() - options.orphan_age_ms);  // by the time of the files
  remove_unused_scratch(store);
}

Sweeper::Sweeper(Store& store, SweepOptions options, EventLog log) {
  thread_ = std::thread([this, &store, options, log = std::move(log)] {
    std::unique_lock lock(lock_);
    while (!stopping_) {
      lock.unlock();
      try {
        sweep(store, options);
      } catch (const std::exception& error) {
        log("sweep_failed", {{"message", error.what()}});
      }
      lock.lock();
      stop_.wait_for(lock, std::chrono::milliseconds(options.every_ms), [&] { return stopping_; });
    }
  });
}

Sweeper::~Sweeper() {
  {
    const std::lock_guard lock(lock_);
    stopping_ = true;
  }
  stop_.notify_all();
  thread_.join();
}

}  // namespace toile
