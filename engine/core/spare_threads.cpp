// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/spare_threads.h"

namespace toile {
namespace {

thread_local SpareThreads* lent = nullptr;

}  // namespace

bool SpareThreads::take() {
  int idle = idle_.load();
  while (idle > 0)
    if (idle_.compare_exchange_weak(idle, idle - 1)) return true;
  return false;
}

SpareThreads* lent_threads() {
  return lent;
}

LendThreads::LendThreads(SpareThreads* threads) : before_(lent) {
  lent = threads;
}

LendThreads::~LendThreads() {
  lent = before_;
}

}  // namespace toile
