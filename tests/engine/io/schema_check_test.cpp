// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/schema_check.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/options_json.h"
#include "engine/io/schema_texts.h"
#include "tests/support/shared_data.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

SchemaCheck check(const std::string& text, const std::string& schema = {}) {
  return check_schema(test::bytes_of(text), schema);
}

TEST(SchemaCheck, EverySchemaIsJsonNamedAfterItsFile) {
  ASSERT_FALSE(schema_texts().empty());
  for (const SchemaText& schema : schema_texts()) {
    const auto document = nlohmann::json::parse(schema.text);
    EXPECT_EQ(document.at("$id"), std::string(schema.name) + ".schema.json");
    EXPECT_EQ(document.at("$schema"), "http://json-schema.org/draft-07/schema#");
    EXPECT_NO_THROW(check("{}", std::string(schema.name))) << schema.name;
  }
}

TEST(SchemaCheck, DefaultOptionsAgreeWithTheirSchema) {
  const SchemaCheck result = check(write_options({}));
  EXPECT_EQ(result.schema, "options");
  EXPECT_TRUE(result.problems.empty());
}

TEST(SchemaCheck, NamesThePlaceOfEveryProblem) {
  const SchemaCheck options = check(R"({"stretch_limit": 7, "preset": "fast"})");
  ASSERT_FALSE(options.problems.empty());
  bool stretch = false, preset = false;
  for (const SchemaProblem& problem : options.problems) {
    stretch = stretch || problem.pointer == "/stretch_limit";
    preset = preset || problem.pointer == "/preset";
  }
  EXPECT_TRUE(stretch);
  EXPECT_TRUE(preset);
  const SchemaCheck garment = check(
      R"({"pattern": {"panels": {"a/b": {"vertices": [[0,0],[1,0],[0,"x"]], "edges": [{"endpoints":[0,1]},{"endpoints":[1,0]}]}}}})");
  EXPECT_EQ(garment.schema, "garment");
  bool vertex = false;
  for (const SchemaProblem& problem : garment.problems)
    vertex = vertex || problem.pointer == "/pattern/panels/a~1b/vertices/2/1";
  EXPECT_TRUE(vertex);
}

TEST(SchemaCheck, SaysWhatIsThereAndWhatWasExpected) {
  const auto said = [](const std::string& text, const std::string& schema) {
    std::string lines;
    for (const SchemaProblem& problem : check(text, schema).problems)
      lines += problem.pointer + " " + problem.message + "\n";
    return lines;
  };
  EXPECT_EQ(said(R"({"stretch_limit": 7})", "options"),
            "/stretch_limit found 7, at least 0.005, at most 0.3 is expected\n");
  EXPECT_EQ(said(R"({"preset": "fast"})", "options"),
            "/preset found \"fast\", expected one of draft, standard, fine\n");
  EXPECT_EQ(said(R"({"l_shapes": 1})", "options"), "/l_shapes expected boolean, found 1\n");
  EXPECT_EQ(said(R"({"schema": "toile/result/1"})", "options"),
            "/schema found \"toile/result/1\", expected toile/options/1\n");
  const std::string unknown = said(R"({"presett": "draft"})", "options");
  EXPECT_TRUE(unknown.starts_with("/ unknown member \"presett\"; known here are alteration_plans, ")) << unknown;
  const std::string job = said(R"({"garment": "skirt"})", "job_request");
  EXPECT_NE(job.find("/garment \"skirt\" has not the form expected here: The id that POST /v1/garments"), job.npos)
      << job;
  EXPECT_NE(job.find("/ the member \"reference_body\" is missing; add it\n"), job.npos) << job;
  // Through a definition that several places share.
  const std::string panel = said(
      R"({"pattern": {"panels": {"a": {"vertices": [[0,0],[1,"x"]], "edges": [{"endpoints":[0,1]},{"endpoints":[1,0]}]}}}})",
      "garment");
  EXPECT_NE(panel.find("/pattern/panels/a/vertices/1/1 expected number, found \"x\"\n"), panel.npos) << panel;
}

TEST(SchemaCheck, RefusesWhatNoSchemaIsKnownFor) {
  EXPECT_THROW(check(R"({"colour": "blue"})"), Error);
  EXPECT_THROW(check(R"({"schema": "toile/nothing/1"})"), Error);
  EXPECT_THROW(check("{}", "nothing"), Error);
  EXPECT_THROW(check("{"), Error);
  EXPECT_THROW(check("[]"), Error);
}

TEST(SchemaCheck, EverySharedGarmentAgreesReadAndWritten) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_garment_names()) {
    SCOPED_TRACE(name);
    const Bytes bytes = test::read_file(test::shared_data("garments/" + name + "_specification.json"));
    EXPECT_TRUE(check_schema(bytes).problems.empty());
    EXPECT_TRUE(check(write_garmentcode(read_garmentcode(bytes))).problems.empty());
  }
}

}  // namespace
}  // namespace toile
