// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a job as JSON: read with every range checked, written in full, listed for help texts and schemas.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/options.h"
#include "engine/core/record.h"
#include "engine/core/types.h"
#include "engine/io/json.h"

namespace toile {

// Options left out keep their defaults, null counts as left out. Throws Error{OptionInvalid} (unknown name, wrong type,
// out of range) whose subject is the JSON pointer, Error{FileMalformed, LimitExceeded} when the bytes are not JSON.
AlterOptions read_options(std::span<const std::uint8_t> bytes);
AlterOptions read_options(const JsonView& object);

// Sets one option from the JSON text of its value ("3", "\"draft\"", "true"); a bare word counts as a string, words
// with commas between them as a list where the option is one. Throws Error{OptionInvalid} with subject "/NAME".
void set_option(AlterOptions& options, const std::string& name, const std::string& value);

// Every option by name; an object that read_options takes back.
Record options_record(const AlterOptions& options);
std::string write_options(const AlterOptions& options);

enum class OptionType { Integer, Number, Boolean, Choice, TextList };

struct OptionInfo {
  std::string name;  // ends in its unit where it has one
  OptionType type = OptionType::Integer;
  double least = 0.0, most = 0.0;    // of integers and numbers, inclusive
  std::vector<std::string> choices;  // of choices and lists
  std::string default_json;
  std::string meaning;  // the sentence of the schema
};
std::vector<OptionInfo> list_options();

// Whether a job can make a file of this name ("all" counts as one).
bool is_output_name(const std::string& name);

}  // namespace toile
