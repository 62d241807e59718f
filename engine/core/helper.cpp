// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/helper.h"

#include <system_error>

#include "engine/core/side_by_side.h"

namespace toile {
namespace {

constexpr int kWatches = 1000;  // some 25 microseconds: longer than from one piece to the next
// The helper goes when it has done less than half of so many pieces.
constexpr std::uint32_t kTrial = 200;

void rest_a_moment() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

// Until `value` is no longer `old`.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  for (int i = 0; i < kWatches; ++i) {
    if (value.load(std::memory_order_acquire) != old) return;
    rest_a_moment();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Helper::Helper() : threads_(lent_threads()) {}

Helper::~Helper() {
  dismiss();
  if (!thread_.joinable()) return;
  leave_ = true;
  ask(nullptr, nullptr);
  thread_.join();
  add_work_cpu_seconds(cpu_s_);
}

void Helper::call() {
  if (here_ || !threads_ || !threads_->take()) return;
  try {
    if (!thread_.joinable()) thread_ = std::thread([this] { serve(); });
    here_ = true;
  } catch (const std::system_error&) {  // the system has none to give
    threads_->give_back();
    threads_ = nullptr;
  }
}

void Helper::dismiss() {
  if (here_) threads_->give_back();
  here_ = false;
}

void Helper::ask(Call run, void* work) {
  call_ = run;
  work_ = work;
  asked_.fetch_add(1, std::memory_order_release);
  asked_.notify_one();
}

bool Helper::claim(std::uint32_t piece) {
  std::uint32_t before = piece - 1;
  return claimed_.compare_exchange_strong(before, piece, std::memory_order_acq_rel);
}

void Helper::judge() {
  const std::uint32_t pieces = asked_.load(std::memory_order_relaxed) - first_piece_;
  if (pieces < kTrial) return;
  const std::uint32_t served = served_.load(std::memory_order_relaxed);
  if (2 * (served - served_before_) < pieces) dismiss();
  first_piece_ += pieces;
  served_before_ = served;
}

void Helper::wait_until_done() const {
  const std::uint32_t last = asked_.load(std::memory_order_relaxed);
  for (std::uint32_t done = done_.load(std::memory_order_acquire); done != last;
       done = done_.load(std::memory_order_acquire))
    wait_for_change(done_, done);
}

void Helper::serve() {
  for (std::uint32_t seen = 0;;) {
    wait_for_change(asked_, seen);
    seen = asked_.load(std::memory_order_acquire);
    if (!claim(seen)) continue;
    if (leave_) break;
    call_(work_);
    served_.fetch_add(1, std::memory_order_relaxed);
    done_.store(seen, std::memory_order_release);
    done_.notify_one();
  }
  cpu_s_ = work_cpu_seconds();
}

}  // namespace toile
