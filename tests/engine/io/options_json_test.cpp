// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/options_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/io/schema_texts.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

using nlohmann::json;

json options_schema() {
  for (const SchemaText& schema : schema_texts())
    if (schema.name == "options") return json::parse(schema.text);
  return {};
}

TEST(OptionsJson, SchemaAndStructAgreeOnEveryOptionItsDefaultAndItsRange) {
  const json properties = options_schema().at("properties");
  const auto options = list_options();
  EXPECT_EQ(properties.size(), options.size() + 1) << "the schema holds every option and the member \"schema\"";
  for (const OptionInfo& option : options) {
    SCOPED_TRACE(option.name);
    ASSERT_TRUE(properties.contains(option.name));
    const json& property = properties.at(option.name);
    EXPECT_EQ(property.at("default"), json::parse(option.default_json));
    EXPECT_FALSE(option.meaning.empty());
    EXPECT_EQ(property.at("description"), option.meaning);
    const std::string type = property.at("type");
    switch (option.type) {
      case OptionType::Integer:
      case OptionType::Number:
        EXPECT_EQ(type, option.type == OptionType::Integer ? "integer" : "number");
        EXPECT_EQ(property.at("minimum").get<double>(), option.least);
        EXPECT_EQ(property.at("maximum").get<double>(), option.most);
        break;
      case OptionType::Boolean: EXPECT_EQ(type, "boolean"); break;
      case OptionType::Choice: EXPECT_EQ(property.at("enum").get<std::vector<std::string>>(), option.choices); break;
      case OptionType::TextList:
        EXPECT_EQ(type, "array");
        EXPECT_EQ(property.at("items").at("enum").get<std::vector<std::string>>(), option.choices);
        break;
    }
  }
}

TEST(OptionsJson, WhatIsWrittenIsReadBack) {
  AlterOptions options;
  options.max_tears_per_side = 3;
  options.stretch_limit = 0.05;
  options.cuts = CutKind::MeshEdges;
  options.solver = SolverKind::Newton;
  options.pin_extremities = true;
  options.triangles = 4321;
  options.outputs = {"ticket.json", "fit.png"};
  const AlterOptions again = read_options(test::bytes_of(write_options(options)));
  EXPECT_EQ(again.max_tears_per_side, 3);
  EXPECT_EQ(again.stretch_limit, 0.05);
  EXPECT_EQ(again.cuts, CutKind::MeshEdges);
  EXPECT_EQ(again.solver, SolverKind::Newton);
  EXPECT_TRUE(again.pin_extremities);
  EXPECT_EQ(again.triangles.value(), 4321);
  EXPECT_EQ(again.outputs, options.outputs);
  EXPECT_EQ(write_options(again), write_options(options));
}

TEST(OptionsJson, EndsOfEveryRangeAreTakenAndWhatLiesBeyondIsRefusedByPointer) {
  for (const OptionInfo& option : list_options()) {
    if (option.type != OptionType::Integer && option.type != OptionType::Number) continue;
    SCOPED_TRACE(option.name);
    for (const double good : {option.least, option.most})
      EXPECT_NO_THROW(read_options(test::bytes_of(json{{option.name, good}}.dump())));
    for (const double bad : {option.least - 0.001, option.most + 0.001}) {
      try {
        read_options(test::bytes_of(json{{option.name, bad}}.dump()));
        ADD_FAILURE() << "accepted " << bad;
      } catch (const Error& error) {
        EXPECT_EQ(error.code, ErrorCode::OptionInvalid);
        EXPECT_EQ(error.subject, "/" + option.name);
      }
    }
  }
}

TEST(OptionsJson, RefusesUnknownNamesAndWrongTypes) {
  const auto pointer_of = [](const std::string& text) {
    try {
      read_options(test::bytes_of(text));
    } catch (const Error& error) {
      return std::string(error_name(error.code)) + " " + error.subject;
    }
    return std::string("accepted");
  };
  EXPECT_EQ(pointer_of(R"({"trianglez": 3})"), "option_invalid /trianglez");
  EXPECT_EQ(pointer_of(R"({"l_shapes": 1})"), "option_invalid /l_shapes");
  EXPECT_EQ(pointer_of(R"({"preset": "fast"})"), "option_invalid /preset");
  EXPECT_EQ(pointer_of(R"({"triangles": 1000.5})"), "option_invalid /triangles");
  EXPECT_EQ(pointer_of(R"({"outputs": [1]})"), "option_invalid /outputs/0");
  EXPECT_EQ(pointer_of(R"({"outputs": ["ticket.json", "ticket.jpg"]})"), "option_invalid /outputs/1");
  EXPECT_EQ(pointer_of("[1]"), "option_invalid /");
  EXPECT_EQ(pointer_of("{"), "file_malformed options");
}

TEST(OptionsJson, SetsOneOptionFromText) {
  AlterOptions options;
  set_option(options, "preset", "fine");
  set_option(options, "seam_preference", "2.5");
  set_option(options, "l_shapes", "true");
  EXPECT_EQ(options.preset, Preset::Fine);
  EXPECT_EQ(options.seam_preference, 2.5);
  EXPECT_TRUE(options.l_shapes);
  EXPECT_FALSE(options.triangles.has_value());
  set_option(options, "outputs", "ticket.json,pattern.png");
  EXPECT_EQ(options.outputs, (std::vector<std::string>{"ticket.json", "pattern.png"}));
  set_option(options, "outputs", R"(["fit.png"])");
  EXPECT_EQ(options.outputs, std::vector<std::string>{"fit.png"});
  EXPECT_EQ(garment_triangles(options), 22000);
  EXPECT_THROW(set_option(options, "l_shapes", "maybe"), Error);
}

}  // namespace
}  // namespace toile
