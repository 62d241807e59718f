// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/words.h"

#include <algorithm>
#include <cstdlib>

namespace toile::bench {

bool Words::flag(const std::string& name) {
  const auto found = std::find(words_.begin(), words_.end(), name);
  if (found == words_.end()) return false;
  words_.erase(found);
  return true;
}

std::optional<std::string> Words::text(const std::string& name) {
  const auto found = std::find(words_.begin(), words_.end(), name);
  if (found == words_.end() || found + 1 == words_.end()) return std::nullopt;
  std::string value = *(found + 1);
  words_.erase(found, found + 2);
  return value;
}

std::optional<double> Words::number(const std::string& name) {
  const std::optional<std::string> value = text(name);
  return value ? std::optional(std::atof(value->c_str())) : std::nullopt;
}

}  // namespace toile::bench
