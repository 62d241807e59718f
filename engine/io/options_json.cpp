// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/options_json.h"

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "engine/io/record_json.h"
#include "engine/io/schema_texts.h"

namespace toile {

using nlohmann::json;

namespace {

constexpr std::size_t kMostOutputs = 100;

// Every file a job can hand over. A name that no job makes would be a job without the file that was asked for.
const std::vector<std::string> kOutputs = {"all",
                                           "altered_pattern.json",
                                           "altered_pattern.svg",
                                           "altered_pattern.dxf",
                                           "altered_pattern.pdf",
                                           "altered_pattern_letter.pdf",
                                           "altered_pattern_a0.pdf",
                                           "altered_pattern_projector.pdf",
                                           "pattern.png",
                                           "target_pattern.json",
                                           "target_pattern.svg",
                                           "ticket.json",
                                           "ticket.html",
                                           "reference_drape.obj",
                                           "target_before.obj",
                                           "target_after.obj",
                                           "target_worn.obj",
                                           "fit_reference.png",
                                           "fit_before.png",
                                           "fit_after.png",
                                           "report.html",
                                           "result.json",
                                           "timings.json",
                                           "tears.png",
                                           "fit_target.png",
                                           "transport.png",
                                           "drape.obj",
                                           "fit.png"};

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

template <class Enum>
struct Choice {
  Enum value;
  const char* name;
};

// The one list of options: every visitor sees each with its range. `options` may be const.
template <class Options, class Visitor>
void visit_options(Options& options, Visitor& visit) {
  visit.integer("max_tears_per_side", options.max_tears_per_side, 0, 5);
  visit.number("seam_preference", options.seam_preference, 1.0, 10.0);
  visit.number("stretch_limit", options.stretch_limit, 0.005, 0.3);
  visit.boolean("l_shapes", options.l_shapes);
  visit.number("cut_smoothness", options.cut_smoothness, 0.0, 1.0);
  visit.template choice<TearWeights>(
      "tear_weights", options.tear_weights,
      {{TearWeights::Release, "release"}, {TearWeights::Boundary, "boundary"}, {TearWeights::Greedy, "greedy"}});
  visit.template choice<CutKind>("cuts", options.cuts,
                                 {{CutKind::Straight, "straight"}, {CutKind::MeshEdges, "mesh-edges"}});
  visit.number("min_strip_mm", options.min_strip_mm, 0.0, 100.0);
  visit.number("min_change_mm", options.min_change_mm, 0.0, 20.0);
  visit.template choice<SymmetryMode>(
      "symmetry", options.symmetry,
      {{SymmetryMode::Auto, "auto"}, {SymmetryMode::Plane, "plane"}, {SymmetryMode::Off, "off"}});
  visit.boolean("pin_extremities", options.pin_extremities);
  visit.integer("physics_passes", options.physics_passes, 1, 5);
  visit.integer("alteration_plans", options.alteration_plans, 1, 5);
  visit.template choice<SolverKind>(
      "solver", options.solver,
      {{SolverKind::Default, "default"}, {SolverKind::Pbd, "pbd"}, {SolverKind::Newton, "newton"}});
  visit.number("fibre_slack", options.fibre_slack, 0.0, 0.2);
  visit.number("shear_limit_deg", options.shear_limit_deg, 0.0, 45.0);
  visit.template choice<Preset>("preset", options.preset,
                                {{Preset::Draft, "draft"}, {Preset::Standard, "standard"}, {Preset::Fine, "fine"}});
  visit.triangles("triangles", options, 500, 200'000);
  visit.template choice<SelfContact>("self_contact", options.self_contact,
                                     {{SelfContact::Auto, "auto"}, {SelfContact::On, "on"}, {SelfContact::Off, "off"}});
  visit.text_list("outputs", options.outputs);
}

class OptionsReader {
 public:
  explicit OptionsReader(const JsonView& object) : object_(object) {}

  void integer(const char* name, int& value, int least, int most) {
    if (const auto given = object_.find(name)) value = given->integer(least, most);
  }
  void number(const char* name, double& value, double least, double most) {
    if (const auto given = object_.find(name)) value = given->number(least, most);
  }
  void boolean(const char* name, bool& value) {
    if (const auto given = object_.find(name)) value = given->boolean();
  }
  template <class Enum>
  void choice(const char* name, Enum& value, std::initializer_list<Choice<Enum>> choices) {
    const auto given = object_.find(name);
    if (!given) return;
    std::string known;
    for (const auto& [candidate, text] : choices) {
      if (given->text() == text) return void(value = candidate);
      known += (known.empty() ? "" : ", ") + std::string(text);
    }
    given->fail("expected one of " + known);
  }
  void triangles(const char* name, AlterOptions& options, int least, int most) {
    if (const auto given = object_.find(name)) options.triangles = given->integer(least, most);
  }
  void text_list(const char* name, std::vector<std::string>& values) {
    const auto given = object_.find(name);
    if (!given) return;
    values.clear();
    for (const JsonView& element : given->elements(kMostOutputs)) {
      values.push_back(element.text(100));
      if (!is_output_name(values.back())) element.fail("no file of this name is made; there are " + listed(kOutputs));
    }
  }

 private:
  const JsonView& object_;
};

class Writer {
 public:
  Record record;

  void integer(const char* name, int value, int, int) { record.add(name, value); }
  void number(const char* name, double value, double, double) { record.add(name, value); }
  void boolean(const char* name, bool value) { record.add(name, value); }
  template <class Enum>
  void choice(const char* name, Enum value, std::initializer_list<Choice<Enum>> choices) {
    for (const auto& [candidate, text] : choices)
      if (candidate == value) record.add(name, text);
  }
  void triangles(const char* name, const AlterOptions& options, int, int) {
    record.add(name, garment_triangles(options));
  }
  void text_list(const char* name, const std::vector<std::string>& values) { record.add(name, Record::Value(values)); }
};

class Lister {
 public:
  std::vector<OptionInfo> options;

  void integer(const char* name, int value, int least, int most) {
    add(name, OptionType::Integer, value).least = least;
    options.back().most = most;
  }
  void number(const char* name, double value, double least, double most) {
    add(name, OptionType::Number, value).least = least;
    options.back().most = most;
  }
  void boolean(const char* name, bool value) { add(name, OptionType::Boolean, value); }
  template <class Enum>
  void choice(const char* name, Enum value, std::initializer_list<Choice<Enum>> choices) {
    OptionInfo& info = add(name, OptionType::Choice, nullptr);
    for (const auto& [candidate, text] : choices) {
      info.choices.emplace_back(text);
      if (candidate == value) info.default_json = json(text).dump();
    }
  }
  void triangles(const char* name, const AlterOptions& values, int least, int most) {
    integer(name, garment_triangles(values), least, most);
  }
  void text_list(const char* name, const std::vector<std::string>& values) {
    add(name, OptionType::TextList, values).choices = kOutputs;
  }

 private:
  OptionInfo& add(const char* name, OptionType type, const json& value) {
    options.push_back({name, type, 0.0, 0.0, {}, value.dump(), {}});
    return options.back();
  }
};

json options_schema() {
  for (const SchemaText& schema : schema_texts())
    if (schema.name == "options") return json::parse(schema.text);
  throw Error(ErrorCode::Internal, "options", "its schema is not built in");
}

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream text(list);
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

void refuse_unknown(const JsonView& object) {
  const auto known = list_options();
  for (const auto& [name, value] : object.members()) {
    const auto same = [&, n = name](const OptionInfo& info) { return info.name == n; };
    if (name == "schema" || std::any_of(known.begin(), known.end(), same)) continue;
    std::vector<std::string> names;
    for (const OptionInfo& info : known) names.push_back(info.name);
    value.fail("no such option; options are " + listed(names));
  }
}

}  // namespace

AlterOptions read_options(const JsonView& object) {
  try {
    refuse_unknown(object);
    AlterOptions options;
    OptionsReader reader(object);
    visit_options(options, reader);
    return options;
  } catch (const Error& error) {
    throw Error(ErrorCode::OptionInvalid, error.subject, error.message);
  }
}

AlterOptions read_options(std::span<const std::uint8_t> bytes) {
  const json document = parse_json(bytes, "options");
  return read_options(JsonView(document));
}

void set_option(AlterOptions& options, const std::string& name, const std::string& value) {
  json one = json::parse(value, nullptr, false);
  if (name == "outputs" && !one.is_array()) one = words_of(value);
  json object = json::parse(write_options(options));
  if (!options.triangles) object.erase("triangles");  // stays open: the preset's
  object[name] = one.is_discarded() ? json(value) : std::move(one);
  options = read_options(JsonView(object));
}

Record options_record(const AlterOptions& options) {
  Writer writer;
  visit_options(options, writer);
  return std::move(writer.record);
}

std::string write_options(const AlterOptions& options) {
  const Bytes text = write_json(options_record(options));
  return std::string(text.begin(), text.end());
}

std::vector<OptionInfo> list_options() {
  const AlterOptions defaults;
  Lister lister;
  visit_options(defaults, lister);
  static const json properties = options_schema().at("properties");
  for (OptionInfo& info : lister.options) info.meaning = properties.at(info.name).at("description");
  return std::move(lister.options);
}

bool is_output_name(const std::string& name) {
  return std::find(kOutputs.begin(), kOutputs.end(), name) != kOutputs.end();
}

}  // namespace toile
