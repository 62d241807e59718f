// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/identifier.h"

#include <array>
#include <cstdint>

#include <sys/random.h>

#include "engine/core/error.h"

namespace toile {

std::string random_identifier(std::string_view prefix) {
  std::array<std::uint8_t, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error(ErrorCode::Internal, "random", "the system's random source does not answer");
  constexpr const char* kDigits = "0123456789abcdef";
  std::string name(prefix);
  name += '_';
  for (const std::uint8_t byte : bytes) {
    name += kDigits[byte >> 4];
    name += kDigits[byte & 15];
  }
  return name;
}

}  // namespace toile
