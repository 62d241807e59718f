// SPDX-License-Identifier: GPL-3.0-or-later
// Wall time in milliseconds since 1970, handed in so that tests own it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

namespace toile {

using Clock = std::function<std::int64_t()>;

inline std::int64_t system_clock_ms() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

}  // namespace toile
