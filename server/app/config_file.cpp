// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/config_file.h"

#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "server/app/files.h"
#include "server/app/usage.h"

namespace toile::app {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

void set(CLI::App& command, const std::string& name, const std::string& value) {
  CLI::Option* option = name == "config" || name == "help" ? nullptr : command.get_option_no_throw("--" + name);
  if (!option) throw std::invalid_argument("there is no setting \"" + name + "\"" + likely_option(command, name));
  if (option->count() > 0) return;
  option->add_result(value);
  option->run_callback();  // checks the value as that of a flag
}

}  // namespace

void apply_config_file(CLI::App& command, const std::string& path) {
  if (path.empty()) return;
  const Bytes bytes = read_file(path);
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  std::string line;
  std::set<std::string> named;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::size_t equals = text.find('=');
    try {
      if (equals == text.npos) throw std::invalid_argument("a setting reads name = value");
      const std::string name = trimmed(text.substr(0, equals));
      if (!named.insert(name).second) throw std::invalid_argument("\"" + name + "\" stands here a second time");
      set(command, name, trimmed(text.substr(equals + 1)));
    } catch (const std::exception& wrong) {
      throw Error(ErrorCode::OptionInvalid, path + ":" + std::to_string(number), wrong.what());
    }
  }
}

}  // namespace toile::app
