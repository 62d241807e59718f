// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of words as JSON text in a column.
#pragma once

#include <string>
#include <vector>

namespace toile {

std::string json_of_words(const std::vector<std::string>& words);
std::vector<std::string> words_of_json(const std::string& text);

}  // namespace toile
