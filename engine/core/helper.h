// SPDX-License-Identifier: GPL-3.0-or-later
// A thread that stands by for work of some ten microseconds, too short for a thread of its own: it watches for the next
// piece for a moment before it sleeps. What it has not begun when the caller is through with the first part, the caller
// does: on a busy machine, where the helper gets no processor, little is lost. The pieces are the same whoever does
// them, so the results are.
#pragma once

#include <cstdint>
#include <thread>
#include <type_traits>

#include "engine/core/spare_threads.h"

namespace toile {

class Helper {
 public:
  // Borrows from what is lent to the thread that makes it, and serves that thread alone.
  Helper();
  ~Helper();
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;

  // Borrows a thread if one is idle, until dismiss() or until it turns out to get no processor. To be tried again now
  // and then.
  void call();
  void dismiss();

  // first() and second(), which need nothing of each other and do not throw; at the same time if the helper is here.
  template <class First, class Second>
  void both(First&& first, Second&& second) {
    if (!here_) {
      first();
      second();
      return;
    }
    using Work = std::remove_reference_t<Second>;
    ask([](void* work) { (*static_cast<Work*>(work))(); }, const_cast<void*>(static_cast<const void*>(&second)));
    first();
    if (claim(asked_.load(std::memory_order_relaxed)))
      second();
    else
      wait_until_done();
    judge();
  }

 private:
  using Call = void (*)(void*);

  void ask(Call run, void* work);
  bool claim(std::uint32_t piece);  // by the first of both who wants to do it
  void wait_until_done() const;
  void judge();
  void serve();

  SpareThreads* threads_;
  bool here_ = false, leave_ = false;
  Call call_ = nullptr;
  void* work_ = nullptr;
  std::atomic<std::uint32_t> asked_{0}, claimed_{0}, done_{0};  // numbers of pieces
  std::atomic<std::uint32_t> served_{0};                        // how many the helper did
  std::uint32_t first_piece_ = 0, served_before_ = 0;           // when what it is worth was last judged
  double cpu_s_ = 0.0;                                          // of the thread, when it has ended
  std::thread thread_;
};

// With or without a helper.
template <class First, class Second>
void both(Helper* helper, First&& first, Second&& second) {
  if (helper) {
    helper->both(first, second);
  } else {
    first();
    second();
  }
}

}  // namespace toile
