// SPDX-License-Identifier: GPL-3.0-or-later
// Two pieces of work that need nothing of each other, at the same time or one after the other: what they return, and
// what they throw, is the same either way.
#pragma once

#include <atomic>
#include <exception>
#include <future>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>

#include "engine/core/spare_threads.h"

namespace toile {

// Processor seconds of this thread and of those that have worked for it in side_by_side(), s.
double work_cpu_seconds();
void add_work_cpu_seconds(double seconds);

namespace side_by_side_detail {

// What a thread of its own hands back.
template <class T>
struct Done {
  std::optional<T> value;
  std::exception_ptr failed;
  double cpu_s = 0.0;
};

template <class Work>
auto attempt(Work& work) {
  Done<std::invoke_result_t<Work&>> done;
  try {
    done.value = work();
  } catch (...) {
    done.failed = std::current_exception();
  }
  done.cpu_s = work_cpu_seconds();
  return done;
}

// One of the job's threads is at work for the second of two; whichever ends first gives it back.
class TwoAtWork {
 public:
  TwoAtWork() : threads_(lent_threads()) {
    if (threads_) threads_->take_ahead();
  }
  void end_one() {
    if (threads_ && !one_has_ended_.exchange(true)) threads_->give_back();
  }
  SpareThreads* threads() const { return threads_; }

 private:
  SpareThreads* threads_;
  std::atomic<bool> one_has_ended_{false};
};

// Empty where the system has no thread to give.
template <class Work>
auto start_thread(Work& work, TwoAtWork& two) -> std::optional<std::future<decltype(attempt(work))>> {
  try {
    return std::async(std::launch::async, [&work, &two] {
      const LendThreads lend(two.threads());
      auto done = attempt(work);
      two.end_one();
      return done;
    });
  } catch (const std::system_error&) {
    return std::nullopt;
  }
}

}  // namespace side_by_side_detail

// The results of both. With `at_once`, `first` runs on a thread of its own and `second` on this one; what `first`
// throws goes before what `second` throws.
template <class First, class Second>
auto side_by_side(bool at_once, First&& first, Second&& second)
    -> std::pair<std::invoke_result_t<First&>, std::invoke_result_t<Second&>> {
  namespace detail = side_by_side_detail;
  if (!at_once) {
    auto result = first();
    return {std::move(result), second()};
  }
  detail::TwoAtWork two;
  auto other = detail::start_thread(first, two);
  if (!other) {
    two.end_one();
    return side_by_side(false, first, second);
  }
  auto here = detail::attempt(second);
  two.end_one();
  auto there = other->get();
  add_work_cpu_seconds(there.cpu_s);
  for (const std::exception_ptr& failed : {there.failed, here.failed})
    if (failed) std::rethrow_exception(failed);
  return {std::move(*there.value), std::move(*here.value)};
}

// The same for work that returns nothing.
template <class First, class Second>
requires std::is_void_v<std::invoke_result_t<First&>> && std::is_void_v<std::invoke_result_t<Second&>>
void side_by_side(bool at_once, First&& first, Second&& second) {
  side_by_side(
      at_once, [&] { return first(), true; }, [&] { return second(), true; });
}

}  // namespace toile
