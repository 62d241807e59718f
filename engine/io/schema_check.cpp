// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/schema_check.h"

// GCC 12 sees an overlapping copy in the inlined string code of valijson (a known false alarm of -Wrestrict).
#pragma GCC diagnostic ignored "-Wrestrict"

#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "engine/core/error.h"
#include "engine/io/json.h"
#include "engine/io/options_json.h"
#include "engine/io/schema_texts.h"
#include "engine/io/schema_words.h"

namespace toile {

using nlohmann::json;

namespace {

constexpr std::size_t kMostProblems = 50;

const SchemaText* find_schema(std::string_view name) {
  const auto& texts = schema_texts();
  const auto found =
      std::find_if(texts.begin(), texts.end(), [&](const SchemaText& text) { return text.name == name; });
  return found == texts.end() ? nullptr : &*found;
}

std::string known_schemas() {
  std::string names;
  for (const SchemaText& text : schema_texts()) names += (names.empty() ? "" : ", ") + std::string(text.name);
  return names;
}

// "toile/result/1" -> "result".
std::string named_schema(const json& document) {
  if (!document.is_object() || !document.contains("schema") || !document["schema"].is_string()) return {};
  const std::string value = document["schema"].get<std::string>();
  const std::size_t from = value.find('/');
  if (value.substr(0, from) != "toile" || from == std::string::npos) return {};
  return value.substr(from + 1, value.find('/', from + 1) - from - 1);
}

std::string recognised_schema(const json& document) {
  if (!document.is_object()) return {};
  if (document.contains("pattern")) return "garment";
  if (document.contains("landmarks_m") || document.contains("landmarks")) return "landmarks";
  if (document.contains("measurements_m") || document.contains("measurements_cm")) return "measurements";
  const auto options = list_options();
  const bool all_options = std::all_of(document.items().begin(), document.items().end(), [&](const auto& item) {
    return std::any_of(options.begin(), options.end(), [&](const OptionInfo& o) { return o.name == item.key(); });
  });
  return all_options && !document.empty() ? "options" : "";
}

// valijson names places as ["pattern"][0]...; a JSON pointer says the same.
std::string pointer_of(const std::vector<std::string>& context) {
  std::string pointer;
  for (const std::string& step : context) {
    if (step.size() < 3 || step.front() != '[') continue;  // <root>
    const bool quoted = step[1] == '"';
    pointer += pointer_step(quoted ? step.substr(2, step.size() - 4) : step.substr(1, step.size() - 2));
  }
  return pointer.empty() ? "/" : pointer;
}

// Loads the schemas that other schemas refer to by file name; they live as long as the loader.
class SchemaLoader {
 public:
  void load(std::string_view text, valijson::Schema& schema) {
    const json& document = keep(text);
    valijson::SchemaParser parser;
    parser.populateSchema(
        valijson::adapters::NlohmannJsonAdapter(document), schema,
        [this](const std::string& uri) { return fetch(uri); }, [](const json*) {});
  }

 private:
  const json& keep(std::string_view text) {
    documents_.push_back(std::make_unique<json>(json::parse(text)));
    return *documents_.back();
  }
  const json* fetch(const std::string& uri) {
    const SchemaText* text = find_schema(uri.substr(0, uri.find(".schema.json")));
    return text ? &keep(text->text) : nullptr;
  }

  std::vector<std::unique_ptr<json>> documents_;
};

}  // namespace

std::vector<std::string> schema_names() {
  std::vector<std::string> names;
  for (const SchemaText& text : schema_texts()) names.emplace_back(text.name);
  return names;
}

SchemaCheck check_schema(std::span<const std::uint8_t> bytes, const std::string& schema_name) {
  const json document = parse_json(bytes, "document");
  SchemaCheck result;
  result.schema = schema_name;
  if (result.schema.empty()) result.schema = named_schema(document);
  if (result.schema.empty()) result.schema = recognised_schema(document);
  const SchemaText* text = find_schema(result.schema);
  if (!text)
    throw Error(ErrorCode::FormatUnknown, "document",
                "no schema is known for this document; name one with a member \"schema\": \"toile/NAME/1\" or with "
                "--schema NAME (" +
                    known_schemas() + ")");
  valijson::Schema schema;
  SchemaLoader loader;
  loader.load(text->text, schema);
  valijson::Validator validator;
  valijson::ValidationResults found;
  const bool agrees = validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &found);
  const json whole = json::parse(text->text);
  for (valijson::ValidationResults::Error error; result.problems.size() < kMostProblems && found.popError(error);) {
    const std::string pointer = pointer_of(error.context);
    const std::string words = schema_words(error.description, pointer, document, whole);
    if (!words.empty()) result.problems.push_back({pointer, words});
  }
  if (!agrees && result.problems.empty()) result.problems.push_back({"/", "does not agree with the schema"});
  return result;
}

}  // namespace toile
