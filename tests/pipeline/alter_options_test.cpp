// SPDX-License-Identifier: GPL-3.0-or-later
// What the user may say of an alteration arrives where it acts, from a document (jobs over HTTP, --options) as from a
// flag; that each changes the outcome is shown by the tests of engine/alter.
#include <functional>

#include <gtest/gtest.h>

#include "engine/io/options_json.h"
#include "engine/stage_options.h"

namespace toile {
namespace {

struct Control {
  const char *name, *value;  // as a flag; as JSON words stand in quotes
  bool word;
  std::function<bool(const AlterPatternOptions&)> arrived;
};

const std::vector<Control> kControls = {
    {"max_tears_per_side", "3", false, [](const auto& o) { return o.max_tears_per_side == 3; }},
    {"seam_preference", "2.5", false, [](const auto& o) { return o.seam_preference == 2.5; }},
    {"stretch_limit", "0.07", false, [](const auto& o) { return o.stretch_limit == 0.07; }},
    {"l_shapes", "true", false, [](const auto& o) { return o.l_shapes; }},
    {"cut_smoothness", "0.25", false, [](const auto& o) { return o.cut_smoothness == 0.25; }},
    {"tear_weights", "boundary", true, [](const auto& o) { return o.choice == TearChoice::Boundary; }},
    {"tear_weights", "greedy", true, [](const auto& o) { return o.choice == TearChoice::Greedy; }},
    {"cuts", "mesh-edges", true, [](const auto& o) { return o.mesh_edge_cuts; }},
    {"min_strip_mm", "32", false, [](const auto& o) { return std::abs(o.least_strip - 0.032) < 1e-12; }},
    {"min_change_mm", "8", false, [](const auto& o) { return std::abs(o.least_change - 0.008) < 1e-12; }},
    {"symmetry", "off", true, [](const auto& o) { return !o.symmetric; }},
};

TEST(AlterationControls, ArriveFromADocumentAndFromAFlag) {
  for (const Control& control : kControls) {
    const std::string quote = control.word ? "\"" : "";
    const std::string text = std::string("{\"") + control.name + "\": " + quote + control.value + quote + "}";
    EXPECT_FALSE(control.arrived(alter_options_of({}))) << control.name << " is the default: nothing is shown";
    EXPECT_TRUE(control.arrived(alter_options_of(read_options(Bytes(text.begin(), text.end()))))) << text;
    AlterOptions given;
    set_option(given, control.name, control.value);
    EXPECT_TRUE(control.arrived(alter_options_of(given))) << control.name;
  }
}

TEST(AlterationControls, HowManyPlansAreTriedArrives) {
  AlterOptions given;
  ASSERT_NE(plan_options_of(given).max_plans, 2);
  set_option(given, "alteration_plans", "2");
  EXPECT_EQ(plan_options_of(given).max_plans, 2);
  const std::string text = "{\"alteration_plans\": 2}";
  EXPECT_EQ(plan_options_of(read_options(Bytes(text.begin(), text.end()))).max_plans, 2);
}

}  // namespace
}  // namespace toile
