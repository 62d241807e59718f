// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/worker_pool.h"

#include <algorithm>
#include <utility>

#include "jobs/store/identifier.h"
#include "jobs/worker/liveness.h"

namespace toile {

namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kIdleWait{250};       // other processes' announcements are not heard: look that often
constexpr milliseconds kLookEvery{150};      // for cancellations and lost leases
constexpr milliseconds kProgressEvery{500};  // between writes of progress
constexpr milliseconds kRecoverEvery{2000};
constexpr milliseconds kErrorWait{1000};  // after a failure of the storage

// Calls `act` when `every` has passed since the last time.
class Ticker {
 public:
  explicit Ticker(milliseconds every) : every_(every), next_(Steady::now() + every) {}
  template <class Act>
  void tick(Act act) {
    if (Steady::now() < next_) return;
    next_ = Steady::now() + every_;
    act();
  }

 private:
  milliseconds every_;
  Steady::time_point next_;
};

const char* outcome_name(Outcome::Kind kind) {
  switch (kind) {
    case Outcome::Kind::Succeeded: return "succeeded";
    case Outcome::Kind::Failed: return "failed";
    case Outcome::Kind::Cancelled: return "cancelled";
    case Outcome::Kind::Crashed: return "crashed";
    case Outcome::Kind::Transient: return "transient";
    case Outcome::Kind::Interrupted: return "interrupted";
  }
  return "failed";
}

Outcome transient(const Error& error) {
  Outcome outcome;
  outcome.kind = error.code == ErrorCode::NotFound || error.code == ErrorCode::Internal ? Outcome::Kind::Failed
                                                                                        : Outcome::Kind::Transient;
  outcome.error = JobError{std::string(error_name(error.code)), error.subject, error.message};
  return outcome;
}

}  // namespace

WorkerPool::WorkerPool(Store& store, WorkerPoolOptions options, EventLog log)
    : store_(store),
      options_(std::move(options)),
      log_(std::move(log)),
      name_(random_identifier("worker")),
      alive_lock_(hold_liveness(store, name_)),
      renewed_(Steady::now()) {
  store_.queue.on_work([this] {
    const std::lock_guard lock(lock_);
    ++announced_;
    changed_.notify_all();
  });
  for (int i = 0; i < options_.workers; ++i) workers_.emplace_back([this] { work(); });
  keeper_ = std::thread([this] { keep_leases(); });
}

WorkerPool::~WorkerPool() {
  drain();
}

void WorkerPool::drain() {
  {
    std::unique_lock lock(lock_);
    if (stopped_) return;
    draining_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, milliseconds(options_.drain_ms), [&] { return running_.empty(); });
    for (const auto& state : running_) state->give_back = true;
  }
  for (std::thread& worker : workers_) worker.join();
  {
    const std::lock_guard lock(lock_);
    stopped_ = true;
    changed_.notify_all();
  }
  keeper_.join();
  store_.queue.on_work(nullptr);
  drop_liveness(store_, name_, alive_lock_);
  try {
    store_.forget_worker(name_);
  } catch (const Error&) {
    // Its row grows old and is removed by another worker.
  }
}

void WorkerPool::work() {
  for (;;) {
    std::uint64_t heard = 0;
    {
      const std::lock_guard lock(lock_);
      if (draining_) return;
      heard = announced_;
    }
    milliseconds wait = kIdleWait;
    try {
      const std::optional<Job> job = store_.queue.claim(name_);
      if (job) {
        run(*job);
        continue;
      }
    } catch (const Error& error) {
      log_("claim_failed", {{"code", std::string(error_name(error.code))}, {"message", error.message}});
      wait = kErrorWait;
    }
    std::unique_lock lock(lock_);
    changed_.wait_for(lock, wait, [&] { return draining_ || announced_ != heard; });
  }
}

void WorkerPool::run(const Job& job) {
  const auto state = std::make_shared<AttemptState>(Lease{job.id, job.attempt});
  {
    const std::lock_guard lock(lock_);
    running_.push_back(state);
  }
  const auto started = Steady::now();
  log_("job_started", {{"job", job.id}, {"attempt", std::to_string(job.attempt)}, {"kind", job.kind}});
  Outcome outcome;
  try {
    outcome = make_attempt(job, store_, options_.attempt, *state);
  } catch (const Error& error) {
    outcome = transient(error);
  }
  bool told = false, accepted = false;
  // A full disk may pass; the lease is kept meanwhile, and if it is not, another worker takes the job.
  for (int attempt = 0; attempt < 3 && !told && !state->lost; ++attempt) {
    try {
      accepted = store_.queue.finish(state->lease(), outcome);
      told = true;
    } catch (const Error& error) {
      outcome = transient(error);
      std::this_thread::sleep_for(kErrorWait);
    }
  }
  const auto took = std::chrono::duration_cast<milliseconds>(Steady::now() - started).count();
  log_("job_ended", {{"job", job.id},
                     {"attempt", std::to_string(job.attempt)},
                     {"outcome", !accepted ? "lease_lost" : outcome_name(outcome.kind)},
                     {"code", outcome.error ? outcome.error->code : ""},
                     {"ms", std::to_string(took)}});
  const std::lock_guard lock(lock_);
  running_.remove(state);
  reported_.erase(job.id);
  changed_.notify_all();
}

std::vector<std::shared_ptr<AttemptState>> WorkerPool::running() const {
  const std::lock_guard lock(lock_);
  return {running_.begin(), running_.end()};
}

void WorkerPool::report_progress(bool all) {
  const auto states = running();
  std::vector<ProgressReport> reports;
  std::vector<std::shared_ptr<AttemptState>> told;
  for (const auto& state : states) {
    const ProgressReport report = state->progress();
    const std::lock_guard lock(lock_);
    if (std::find(running_.begin(), running_.end(), state) == running_.end()) continue;  // it ended meanwhile
    ProgressReport& last = reported_[report.lease.job];
    const bool news = report.stage != last.stage || report.progress != last.progress;
    if (!all && !news) continue;
    last = report;
    reports.push_back(report);
    told.push_back(state);
  }
  const std::vector<LeaseState> answers = store_.queue.heartbeat(reports);
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i] == LeaseState::Lost) told[i]->lost = true;
  if (all) renewed_ = Steady::now();
}

void WorkerPool::look_for_changes() {
  const auto states = running();
  std::vector<Lease> leases;
  for (const auto& state : states) leases.push_back(state->lease());
  const std::vector<LeaseState> answers = store_.queue.look(leases);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i] == LeaseState::CancelRequested) states[i]->cancel = true;
    if (answers[i] == LeaseState::Lost) states[i]->lost = true;
  }
}

void WorkerPool::keep_leases() {
  Ticker heartbeat(milliseconds(options_.heartbeat_ms)), progress(kProgressEvery), recover(kRecoverEvery);
  const auto note = [&] { store_.note_worker({name_, 0, options_.workers, static_cast<int>(running().size())}); };
  const auto recover_jobs = [&] {
    for (const std::string& dead : bury_dead_workers(store_)) {
      store_.queue.give_back_jobs_of(dead);
      store_.forget_worker(dead);
    }
    store_.queue.recover_expired();
  };
  bool first = true;
  for (;;) {
    {
      std::unique_lock lock(lock_);
      changed_.wait_for(lock, kLookEvery, [&] { return stopped_; });
      if (stopped_) return;
    }
    try {
      if (std::exchange(first, false)) {
        note();
        recover_jobs();
      }
      look_for_changes();
      progress.tick([&] { report_progress(false); });
      heartbeat.tick([&] {
        report_progress(true);
        note();
      });
      recover.tick(recover_jobs);
    } catch (const Error& error) {
      log_("lease_keeper_failed", {{"code", std::string(error_name(error.code))}, {"message", error.message}});
      if (Steady::now() - renewed_ > milliseconds(options_.lease_ms))
        for (const auto& state : running()) state->lost = true;
      std::this_thread::sleep_for(kErrorWait);
    }
  }
}

}  // namespace toile
