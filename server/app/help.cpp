// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/help.h"

#include <algorithm>
#include <sstream>

namespace toile::app {

namespace {

constexpr std::size_t kTextWidth = 76;  // beside the column of names

std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines;
  std::size_t used = 0;
  for (std::string word; words >> word;) {
    const bool fits = used + 1 + word.size() <= kTextWidth;
    if (used > 0) lines += fits ? ' ' : '\n';
    used = (used > 0 && fits ? used + 1 : 0) + word.size();
    lines += word;
  }
  return lines;
}

// The library writes "TEXT:{m,cm}" and "INT:INT in [0 - 9]": the kind of value, and what holds it in.
std::pair<std::string, std::string> kind_and_bound(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  return {type.substr(0, colon), colon == type.npos ? "" : type.substr(colon + 1)};
}

std::string in_words(std::string bound) {
  if (const std::size_t from = bound.find('['); from != bound.npos) {
    bound = bound.substr(from + 1, bound.find(']') - from - 1);
    return bound.replace(bound.find(" - "), 3, " to ");
  }
  if (!bound.starts_with('{')) return bound;
  std::string words = "one of ";
  for (const char c : bound.substr(1, bound.size() - 2)) words += c == ',' ? std::string(", ") : std::string(1, c);
  return words;
}

}  // namespace

std::string HelpText::make_option_opts(const CLI::Option* option) const {
  if (option->get_type_size() == 0) return "";
  const std::string kind = kind_and_bound(*option).first;
  return " " + (kind == "TEXT" ? "WORD" : kind == "INT" ? "NUMBER" : kind);
}

std::string HelpText::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (option->get_type_size() != 0) {
    if (const std::string bound = kind_and_bound(*option).second; !bound.empty()) add(in_words(bound));
    if (!option->get_default_str().empty()) add("default " + option->get_default_str());
  }
  if (option->get_required()) add("must be given");
  if (!option->get_envname().empty()) add("variable " + option->get_envname());
  return wrapped(text);
}

std::string HelpText::make_footer(const CLI::App* app) const {
  if (!app->get_parent()) return CLI::Formatter::make_footer(app);
  const bool own = app->get_footer() != app->get_parent()->get_footer();
  return (own ? CLI::Formatter::make_footer(app) : "") +
         "\ntoile --help tells of --threads, --quiet and --json-log, and of exit codes.\n";
}

}  // namespace toile::app
