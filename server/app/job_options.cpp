// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/job_options.h"

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/io/options_json.h"
#include "server/app/files.h"

namespace toile::app {

namespace {

constexpr std::array kOfDrapes = {"pin_extremities", "solver",    "fibre_slack",  "shear_limit_deg",
                                  "preset",          "triangles", "self_contact", "outputs"};

std::string flag_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::string kind_of(const OptionInfo& info) {
  switch (info.type) {
    case OptionType::Integer:
    case OptionType::Number: return "NUMBER";
    case OptionType::Boolean: return "true|false";
    case OptionType::Choice: return "WORD";
    case OptionType::TextList: return "NAME,NAME";
  }
  return "WORD";
}

std::string bound_of(const OptionInfo& info) {
  const auto number = [](double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
  };
  if (info.type == OptionType::Integer || info.type == OptionType::Number)
    return "; " + number(info.least) + " to " + number(info.most);
  if (info.type != OptionType::Choice) return "";
  std::string words;
  for (const std::string& choice : info.choices) words += (words.empty() ? "; one of " : ", ") + choice;
  return words;
}

std::string help_of(const OptionInfo& info) {
  std::string text = info.meaning, value = info.default_json;
  if (text.ends_with('.')) text.pop_back();
  std::erase_if(value, [](char c) { return c == '"' || c == '[' || c == ']'; });
  return text + bound_of(info) + "; default " + (info.name == "triangles" ? "the preset's" : value);
}

}  // namespace

void add_job_options(CLI::App& command, const std::shared_ptr<JobOptions>& options, JobWork work) {
  command
      .add_option("--options", options->file,
                  "File with any of the options below, in JSON: {\"preset\": \"draft\"}; a flag given as well counts "
                  "more")
      ->type_name("FILE");
  for (const OptionInfo& info : list_options()) {
    const bool of_drapes = std::find(kOfDrapes.begin(), kOfDrapes.end(), info.name) != kOfDrapes.end();
    const char* group = of_drapes ? "How it is computed" : work == JobWork::Drape ? "" : "What the alteration may do";
    command
        .add_option_function<std::string>(
            flag_of(info.name), [options, name = info.name](const std::string& value) { options->given[name] = value; },
            help_of(info))
        ->type_name(kind_of(info))
        ->group(group);
  }
}

AlterOptions read_job_options(const JobOptions& given, JobWork work) {
  AlterOptions options;
  try {
    if (!given.file.empty()) options = read_options(read_file(given.file));
    if (!given.given.contains("outputs")) check_outputs(options, work);
  } catch (const Error& error) {
    if (error.code == ErrorCode::FileUnreadable) throw;
    throw Error(error.code, given.file + "#" + error.subject, error.message);
  }
  for (const auto& [name, value] : given.given) {
    try {
      set_option(options, name, value);
      if (name == "outputs") check_outputs(options, work);
    } catch (const Error& error) {
      throw Error(error.code, flag_of(name) + " " + value, error.message);
    }
  }
  return options;
}

}  // namespace toile::app
