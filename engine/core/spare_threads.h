// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that a job may use and that nothing of it uses just now. Whoever runs the job lends them to the work on a
// thread; work on them may borrow one while it pays. What is computed never depends on whether there was one to borrow.
#pragma once

#include <atomic>

namespace toile {

class SpareThreads {
 public:
  explicit SpareThreads(int count) : idle_(count) {}

  bool any_idle() const { return idle_.load() > 0; }
  // False where none is idle.
  bool take();
  // Takes one where none may be idle: the next that is given back makes up for it.
  void take_ahead() { idle_.fetch_sub(1); }
  void give_back() { idle_.fetch_add(1); }

 private:
  std::atomic<int> idle_;
};

// Those lent to the work on this thread, or null.
SpareThreads* lent_threads();

// Lends them to this thread as long as it lives; may be null.
class LendThreads {
 public:
  explicit LendThreads(SpareThreads* threads);
  ~LendThreads();
  LendThreads(const LendThreads&) = delete;
  LendThreads& operator=(const LendThreads&) = delete;

 private:
  SpareThreads* before_;
};

}  // namespace toile
