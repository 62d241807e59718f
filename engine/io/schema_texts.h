// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON Schemas of the folder schemas/, built into the program.
#pragma once

#include <string_view>
#include <vector>

namespace toile {

struct SchemaText {
  std::string_view name;  // "garment", "options", ...
  std::string_view text;  // JSON Schema, draft 7
};

const std::vector<SchemaText>& schema_texts();  // sorted by name

}  // namespace toile
