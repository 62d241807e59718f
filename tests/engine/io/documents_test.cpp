// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/io/base64.h"
#include "engine/io/record_json.h"
#include "engine/io/report_html.h"
#include "engine/io/schema_check.h"
#include "engine/io/ticket_document.h"
#include "tests/support/sample_ticket.h"
#include "tests/support/text_bytes.h"

namespace toile {
namespace {

// Every element that needs it is closed.
void expect_balanced(const std::string& html) {
  for (const std::string tag :
       {"html", "head", "body", "ol", "ul", "li",     "div",        "span",    "table", "thead", "tbody",
        "tr",   "td",   "dl",   "dt", "dd", "figure", "figcaption", "details", "svg",   "h2"})
    EXPECT_EQ(test::count_of(html, "<" + tag + ">") + test::count_of(html, "<" + tag + " "),
              test::count_of(html, "</" + tag + ">"))
        << tag;
}

TEST(Base64, MatchesTheVectorsOfItsStandard) {
  const auto encoded = [](std::string_view text) { return base64(Bytes(text.begin(), text.end())); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(TicketDocument, JsonCarriesMillimetresInTheOrderOfWork) {
  const Bytes bytes = write_json(ticket_record(test::sample_ticket()));
  const auto json = nlohmann::json::parse(bytes.begin(), bytes.end());
  EXPECT_EQ(json["schema"], "toile/ticket/1");
  ASSERT_EQ(json["operations"].size(), 3u);
  const auto& take_in = json["operations"][0];
  EXPECT_EQ(take_in["op"], "take_in");
  EXPECT_EQ(take_in["order"], 1);
  EXPECT_DOUBLE_EQ(take_in["per_ply_mm"], 12.0);
  EXPECT_DOUBLE_EQ(take_in["total_mm"], 48.0);
  EXPECT_DOUBLE_EQ(take_in["profile"]["spacing_mm"], 20.0);
  EXPECT_EQ(take_in["profile"]["per_ply_mm"].size(), 12u);
  EXPECT_DOUBLE_EQ(take_in["removed_area_cm2"], 61.0);
  EXPECT_EQ(take_in["sides"][0]["edges"], nlohmann::json({3, 4}));
  const auto& insert = json["operations"][2];
  EXPECT_EQ(insert["fabric"], "needs_fabric");
  EXPECT_DOUBLE_EQ(insert["seam_allowance"]["left_mm"], -25.0);
  EXPECT_DOUBLE_EQ(insert["pieces"][0]["grain_deg"], 12.0);
  EXPECT_DOUBLE_EQ(insert["pieces"][0]["area_cm2"], 139.5);
}

TEST(TicketDocument, JsonAgreesWithItsSchemaAndAWrongOneDoesNot) {
  const Bytes bytes = write_json(ticket_record(test::sample_ticket()));
  const SchemaCheck check = check_schema(bytes);
  EXPECT_EQ(check.schema, "ticket");
  for (const SchemaProblem& problem : check.problems) ADD_FAILURE() << problem.pointer << ": " << problem.message;
  auto json = nlohmann::json::parse(bytes.begin(), bytes.end());
  json["operations"][0]["op"] = "cut_off";
  json["operations"][1]["per_ply_mm"] = -1;
  const std::string wrong = json.dump();
  EXPECT_FALSE(check_schema(Bytes(wrong.begin(), wrong.end())).problems.empty());
}

TEST(TicketDocument, EdgesAreWholeNumbers) {
  const std::string json = test::text_of(write_json(ticket_record(test::sample_ticket())));
  const std::size_t edges = json.find("\"edges\"");
  ASSERT_NE(edges, std::string::npos);
  EXPECT_EQ(json.substr(edges, json.find(']', edges) - edges).find('.'), std::string::npos);
}

TEST(TicketDocument, ThePageSaysEverySentenceOnceAndEscapesNames) {
  const std::string html = test::text_of(write_ticket_html(test::sample_ticket(), {}, "2026-01-31"));
  for (const TicketOperation& operation : test::sample_ticket().operations)
    EXPECT_EQ(test::count_of(html, operation.sentence), 1);
  EXPECT_NE(html.find("hem &lt;front&gt; &amp; back"), std::string::npos);
  EXPECT_NE(html.find("25 mm short"), std::string::npos);
  EXPECT_NE(html.find("needs new fabric"), std::string::npos);
  EXPECT_NE(html.find("insertion_1"), std::string::npos);
  EXPECT_EQ(test::count_of(html, "class=\"profile\""), 3);
  expect_balanced(html);
}

TEST(TicketDocument, WithoutOperationsItSaysThatNothingIsToBeDone) {
  Ticket ticket;
  ticket.garment = "shirt";
  EXPECT_NE(test::text_of(write_ticket_html(ticket)).find("Nothing to alter"), std::string::npos);
}

TEST(Report, IsOneSelfContainedPage) {
  const Ticket ticket = test::sample_ticket();
  Report report;
  report.title = "Alteration of <shirt>";
  report.summary = {"Three operations."};
  report.fits = {{Bytes{1, 2, 3}, "before"}, {Bytes{4, 5, 6}, "after"}};
  report.zones = {{"Stretch", {"panel", "before", "after"}, {{"front", "5.1 %", "0.4 %"}}}};
  report.ticket = &ticket;
  report.quality = {{"Drapes", {"", "before"}, {{"stretch error", "1.23 %"}}}};
  report.findings = {"panel front: 4 % stretch is left"};
  report.options.add("preset", "standard");
  const std::string html = test::text_of(write_report_html(report));
  EXPECT_EQ(test::count_of(html, "data:image/png;base64,"), 2);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_NE(html.find("name=\"viewport\""), std::string::npos);
  EXPECT_NE(html.find("Alteration of &lt;shirt&gt;"), std::string::npos);
  EXPECT_NE(html.find("<td>1.23 %</td>"), std::string::npos);
  EXPECT_NE(html.find("<li>panel front: 4 % stretch is left</li>"), std::string::npos);
  EXPECT_NE(html.find("<dt>preset</dt><dd>standard</dd>"), std::string::npos);
  EXPECT_NE(html.find("<td>5.1 %</td>"), std::string::npos);
  expect_balanced(html);
}

TEST(Report, SectionsWithoutContentAreLeftOut) {
  Report report;
  report.title = "empty";
  EXPECT_EQ(test::count_of(test::text_of(write_report_html(report)), "<h2>"), 0);
}

}  // namespace
}  // namespace toile
