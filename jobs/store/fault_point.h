// SPDX-License-Identifier: GPL-3.0-or-later
// Places where a power cut or a full disk would strike: before every statement and every step of a durable file write.
// Tests set a hook that ends the process or throws there; without one it costs a load.
#pragma once

#include <atomic>

namespace toile {

using FaultHook = void (*)(const char* where);
inline std::atomic<FaultHook> fault_hook{nullptr};

inline void fault_point(const char* where) {
  if (const FaultHook hook = fault_hook.load(std::memory_order_relaxed)) hook(where);
}

}  // namespace toile
