// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/json_text.h"

#include <nlohmann/json.hpp>

namespace toile {

std::string json_of_words(const std::vector<std::string>& words) {
  return nlohmann::json(words).dump();
}

std::vector<std::string> words_of_json(const std::string& text) {
  const auto list = nlohmann::json::parse(text, nullptr, false);
  return list.is_array() ? list.get<std::vector<std::string>>() : std::vector<std::string>();
}

}  // namespace toile
