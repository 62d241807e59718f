// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/usage.h"

#include <algorithm>
#include <numeric>

namespace toile::app {

namespace {

// Letters to be changed, left out or put in to make one word of the other.
std::size_t edits_between(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// The known word most like `word`, with `mark` in front, as a question; or where to look.
std::string instead_of(const std::string& word, const std::vector<std::string>& known, const std::string& mark,
                       const std::string& help) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edits_between(word, a) < edits_between(word, b);
  });
  if (nearest == known.end() || edits_between(word, *nearest) > 1 + word.size() / 4) return "; see " + help + " --help";
  return "; did you mean " + mark + *nearest + "?";
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : commands_of(app))
    if (command->check_name(name)) return command;
  return nullptr;
}

std::string unknown_command(const CLI::App& app, const std::string& name) {
  std::vector<std::string> known;
  for (const CLI::App* command : commands_of(app))
    if (!command->get_group().empty()) known.push_back(command->get_name());
  return "there is no command \"" + name + "\"" + instead_of(name, known, "", "toile");
}

const CLI::Option* find_option(const CLI::App& app, const CLI::App* command, const std::string& name) {
  if (command)
    if (const CLI::Option* own = command->get_option_no_throw("--" + name)) return own;
  return app.get_option_no_throw("--" + name);
}

}  // namespace

std::string likely_option(const CLI::App& command, const std::string& name) {
  std::vector<std::string> known;
  for (const CLI::App* one = &command; one; one = one->get_parent())
    for (const CLI::Option* option : one->get_options())
      known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
  return instead_of(name, known, "--", (command.get_parent() ? "toile " : "") + command.get_name());
}

std::optional<std::string> find_wrong_word(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = nullptr;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") break;
    if (word.starts_with("--")) {
      const std::string name = word.substr(2, word.find('=') - 2);
      const CLI::Option* option = find_option(app, command, name);
      if (!option) return "there is no option --" + name + likely_option(command ? *command : app, name);
      if (option->get_items_expected_max() > 0 && word.find('=') == word.npos) ++i;  // what follows is its value
    } else if (!command && !word.starts_with('-')) {
      command = find_command(app, word);
      if (!command) return unknown_command(app, word);
    }
  }
  return std::nullopt;
}

std::string tell_usage(const CLI::App* app, const CLI::Error& error) {
  const auto parsed = app->get_subcommands();
  const std::string place = parsed.empty() ? "toile" : "toile " + parsed.front()->get_name();
  return std::string("toile: ") + error.what() + "; see " + place + " --help\n";
}

}  // namespace toile::app
