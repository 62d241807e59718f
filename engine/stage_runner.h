// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a stage, or reads its result back where the same stage has run on the same inputs before.
//
// The key of a result is a hash of the stage's name and version, the keys of its inputs and its options; two results
// with one key are equal, so a key stands for its value downstream. Clocks are kept apart from results.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/archive.h"
#include "engine/core/content_hash.h"
#include "engine/core/progress.h"
#include "engine/core/stage_cache.h"

namespace toile {

template <class T>
struct Keyed {
  T value;
  std::string key;  // 64 hexadecimal digits
};

struct StageTiming {
  std::string stage;
  double cpu_s = 0.0, wall_s = 0.0;  // of the thread that ran it
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

  // Both may be null; they must outlive the runner. `stages` is how many the whole job runs.
  StageRunner(StageCache* cache, const Progress* progress, int stages);

  // To be handed to stages: what they report as a fraction of their own work is passed on as one of the whole job.
  Progress* progress() { return &stage_progress_; }

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
    if (cache_) {
      if (const auto bytes = cache_->get(result.key)) {
        result.value = from_bytes<Result>(*bytes);
        reused = true;
      }
    }
    if (!reused) {
      result.value = std::forward<Work>(work)();
      if (cache_) cache_->put(result.key, to_bytes(result.value));
    }
    timings_.push_back(start.until_now(std::string(stage), reused));
    report(&stage_progress_, stage, 1.0);
    ++stages_done_;
    return result;
  }

  // Counts a stage as done that nothing needs.
  void skip(std::string_view stage) {
    stage_ = stage;
    ++stages_done_;
    report(&stage_progress_, stage, 0.0);
  }

  const std::vector<StageTiming>& timings() const { return timings_; }

 private:
  struct Clocks {
    double cpu = thread_cpu_seconds();
    std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();

    static double thread_cpu_seconds() {
      timespec t{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
      return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }
    StageTiming until_now(std::string stage, bool reused) const {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - wall;
      return {std::move(stage), thread_cpu_seconds() - cpu, elapsed.count(), reused};
    }
  };

  StageCache* cache_;
  Progress stage_progress_;
  std::string stage_;  // the pipeline's name for what runs now
  int stages_, stages_done_ = 0;
  double furthest_ = 0.0;
  std::vector<StageTiming> timings_;
};

inline StageRunner::StageRunner(StageCache* cache, const Progress* progress, int stages)
    : cache_(cache), stages_(stages) {
  if (!progress) return;
  stage_progress_.cancelled = progress->cancelled;
  stage_progress_.report = [this, progress](std::string_view, double fraction) {
    furthest_ = std::max(furthest_, std::min(1.0, (stages_done_ + fraction) / stages_));  // a stage may go in rounds
    if (progress->report) progress->report(stage_, furthest_);
  };
}

}  // namespace toile
