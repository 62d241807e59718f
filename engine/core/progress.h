// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of long work, and the wish to end it early. Stages take a `Progress*` that may be null.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "engine/core/error.h"

namespace toile {

struct Progress {
  // Called from the thread that runs the stage; `fraction` of this stage, 0..1, never falling.
  std::function<void(std::string_view stage, double fraction)> report;
  const std::atomic<bool>* cancelled = nullptr;
};

// Throws Error{Cancelled} once cancellation is asked for. Stages call it at least every 100 ms of work.
inline void check_cancelled(const Progress* progress) {
  if (progress && progress->cancelled && progress->cancelled->load(std::memory_order_relaxed))
    throw Error(ErrorCode::Cancelled, "job", "cancelled on request");
}

inline void report(const Progress* progress, std::string_view stage, double fraction) {
  check_cancelled(progress);
  if (progress && progress->report) progress->report(stage, fraction);
}

}  // namespace toile
