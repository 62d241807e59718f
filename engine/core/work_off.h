// SPDX-License-Identifier: GPL-3.0-or-later
// Works off a list whose items need nothing of each other: with one of the job's threads that is idle, or alone.
#pragma once

#include <atomic>
#include <vector>

#include "engine/core/side_by_side.h"

namespace toile {

// work(i) for every i below `count`. Each must write to a place of its own. Throws what the first of the items that
// failed has thrown, after all have been tried.
template <class Work>
void work_off(std::size_t count, Work&& work) {
  std::vector<std::exception_ptr> failed(count);
  std::atomic<std::size_t> next{0};
  const auto some = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        failed[i] = std::current_exception();
      }
    }
  };
  const bool at_once = count > 1 && lent_threads() && lent_threads()->any_idle();
  if (at_once)
    side_by_side(true, some, some);
  else
    some();
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace toile
