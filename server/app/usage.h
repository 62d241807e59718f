// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with the words of a command line: options and commands that are not there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace toile::app {

// The first word that names no command and no option of its command, told with the one that was probably meant; empty
// if every word has its place. To be asked before the library parses: of a misspelt option it would only say that the
// right one is missing. Values are not looked at.
std::optional<std::string> find_wrong_word(const CLI::App& app, const std::vector<std::string>& words);

// "; did you mean --NAME?", or where the options of the command are told, as the end of a sentence.
std::string likely_option(const CLI::App& command, const std::string& name);

// What the library says of a wrong line, and where to read more.
std::string tell_usage(const CLI::App* app, const CLI::Error& error);

}  // namespace toile::app
