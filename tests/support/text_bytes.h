// SPDX-License-Identifier: GPL-3.0-or-later
// Text as the bytes of a file, and back.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/types.h"

namespace toile::test {

inline Bytes bytes_of(std::string_view text) {
  return Bytes(text.begin(), text.end());
}

inline std::string text_of(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

// How often `what` stands in the text.
inline int count_of(std::string_view text, std::string_view what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

}  // namespace toile::test
