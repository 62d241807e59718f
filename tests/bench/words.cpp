// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/words.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

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

std::optional<int> Words::integer(const std::string& name) {
  const std::optional<double> value = number(name);
  return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

std::optional<std::vector<std::string>> Words::list(const std::string& name) {
  const std::optional<std::string> value = text(name);
  if (!value) return std::nullopt;
  std::vector<std::string> parts;
  std::istringstream in(*value);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

}  // namespace toile::bench
