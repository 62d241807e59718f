// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a stage, or reads its result back where the same stage has run on the same inputs before.
//
// The key of a result is a hash of the stage's name and version, the keys of its inputs and its options; two results
// with one key are equal, so a key stands for its value downstream. Clocks are kept apart from results. Stages that
// need nothing of each other may run at the same time: their results and their order in the timings stay the same.
// Threads of the job that are idle are lent to the stages.
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/archive.h"
#include "engine/core/content_hash.h"
#include "engine/core/progress.h"
#include "engine/core/side_by_side.h"
#include "engine/core/spare_threads.h"
#include "engine/core/stage_cache.h"

namespace toile {

template <class T>
struct Keyed {
  T value;
  std::string key;  // 64 hexadecimal digits
};

struct StageTiming {
  std::string stage;
  double cpu_s = 0.0, wall_s = 0.0;  // of the threads that ran it
  bool reused = false;               // read back instead of run
};

// Key of what enters the pipeline from outside.
template <class... T>
std::string key_of(const T&... values) {
  ArchiveWriter writer;
  writer(values...);
  return sha256_hex(writer.bytes());
}

class StageRunner {
 public:
  StageRunner(const StageRunner&) = delete;
  StageRunner& operator=(const StageRunner&) = delete;

  // Both may be null; they must outlive the runner, and are asked by one thread at a time. `stages` is how many the
  // whole job runs.
  StageRunner(StageCache* cache, const Progress* progress, int stages, int threads = 1);

  // To be handed to stages: what they report as a fraction of their own work is passed on as one of the whole job.
  Progress* progress() { return &stage_progress_; }
  // Whether a stage may use a second thread.
  bool at_once() const { return job_->threads > 1; }

  // `work()` returns the stage's result, which archive() writes and reads. `inputs` are keys and archived options.
  template <class Work>
  auto run(std::string_view stage, int version, const std::string& inputs, Work&& work)
      -> Keyed<std::invoke_result_t<Work>> {
    using Result = std::invoke_result_t<Work>;
    stage_ = stage;
    report(&stage_progress_, stage, 0.0);
    const Clocks start;
    Keyed<Result> result{{}, key_of(std::string(stage), version, inputs)};
    bool reused = false;
    if (const auto bytes = job_->get(result.key)) {
      result.value = from_bytes<Result>(*bytes);
      reused = true;
    } else {
      const LendThreads lend(&job_->spare);
      result.value = std::forward<Work>(work)();
      if (job_->cache) job_->put(result.key, to_bytes(result.value));
    }
    timings_.push_back(start.until_now(std::string(stage), reused));
    report(&stage_progress_, stage, 1.0);
    job_->end_stage();
    return result;
  }

  // What `first(runner)` and `second(runner)` return: parts of the job that need nothing of each other.
  template <class First, class Second>
  auto run_both(First&& first, Second&& second) {
    StageRunner one(*job_), other(*job_);
    const LendThreads lend(&job_->spare);
    auto both = side_by_side(
        at_once(), [&] { return first(one); }, [&] { return second(other); });
    for (const StageRunner* part : {&one, &other})
      timings_.insert(timings_.end(), part->timings_.begin(), part->timings_.end());
    return both;
  }

  // Counts a stage as done that nothing needs.
  void skip(std::string_view stage) {
    stage_ = stage;
    job_->end_stage();
    report(&stage_progress_, stage, 0.0);
  }

  const std::vector<StageTiming>& timings() const { return timings_; }

 private:
  // What the parts of a job share.
  struct Job {
    StageCache* cache;
    const Progress* progress;
    int stages, threads;
    SpareThreads spare{threads - 1};
    std::mutex mutex{};
    int stages_done = 0;
    double furthest = 0.0;

    std::optional<Bytes> get(const std::string& key) {
      if (!cache) return std::nullopt;
      const std::lock_guard lock(mutex);
      return cache->get(key);
    }
    void put(const std::string& key, const Bytes& value) {
      const std::lock_guard lock(mutex);
      cache->put(key, value);
    }
    void end_stage() {
      const std::lock_guard lock(mutex);
      ++stages_done;
    }
    void report(std::string_view stage, double fraction) {
      const std::lock_guard lock(mutex);
      furthest = std::max(furthest, std::min(1.0, (stages_done + fraction) / stages));  // a stage may go in rounds
      if (progress->report) progress->report(stage, furthest);
    }
  };

  struct Clocks {
    double cpu = work_cpu_seconds();
    std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();

    StageTiming until_now(std::string stage, bool reused) const {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - wall;
      return {std::move(stage), work_cpu_seconds() - cpu, elapsed.count(), reused};
    }
  };

  explicit StageRunner(Job& job) : job_(&job) { pass_on_progress(); }
  void pass_on_progress();

  std::unique_ptr<Job> whole_;  // of the runner that others are parts of
  Job* job_;
  Progress stage_progress_;
  std::string stage_;  // the pipeline's name for what runs now
  std::vector<StageTiming> timings_;
};

inline StageRunner::StageRunner(StageCache* cache, const Progress* progress, int stages, int threads)
    : whole_(new Job{cache, progress, stages, threads}), job_(whole_.get()) {
  pass_on_progress();
}

inline void StageRunner::pass_on_progress() {
  if (!job_->progress) return;
  stage_progress_.cancelled = job_->progress->cancelled;
  stage_progress_.report = [this](std::string_view, double fraction) { job_->report(stage_, fraction); };
}

}  // namespace toile
