// SPDX-License-Identifier: GPL-3.0-or-later
// Looks at the head of a request before the HTTP library does, and refuses what the library does not protect from:
// bodies of unknown length, compressed bodies, many ranges, many or long header lines, bad lengths.
#pragma once

#include "server/http/problem.h"

namespace toile::http {

struct HeadLimits {
  std::size_t head_bytes = 32 << 10;  // request line and headers together
  std::size_t headers = 64;
  std::size_t target_bytes = 2048;
};

struct Head {
  std::size_t size = 0;  // bytes of the head, blank line included
  std::int64_t content_length = 0;
  bool expects_continue = false;
};

enum class HeadState { Incomplete, Complete, Refused };

struct HeadResult {
  HeadState state = HeadState::Incomplete;
  Head head;
  Problem refusal;
};

// `bytes` is all that has come so far.
HeadResult examine_head(std::string_view bytes, const HeadLimits& limits);

}  // namespace toile::http
