// SPDX-License-Identifier: GPL-3.0-or-later
// Problems of a document with its schema in the words of whoever wrote the document: what is there, what was expected.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace toile {

// `complaint` is what the validator says of the value at `pointer` in `document`; `schema` is the whole schema. Empty
// for a complaint that only says that a value further in has been complained of.
std::string schema_words(const std::string& complaint, const std::string& pointer, const nlohmann::json& document,
                         const nlohmann::json& schema);

}  // namespace toile
