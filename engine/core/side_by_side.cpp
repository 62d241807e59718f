// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/side_by_side.h"

#include <ctime>

namespace toile {
namespace {

thread_local double others_cpu_s = 0.0;

}  // namespace

double work_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec) + others_cpu_s;
}

void add_work_cpu_seconds(double seconds) {
  others_cpu_s += seconds;
}

}  // namespace toile
