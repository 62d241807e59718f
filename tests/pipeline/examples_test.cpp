// SPDX-License-Identifier: GPL-3.0-or-later
// The garments of schemas/examples: drafted as README.md there says, and they fit whom they were drafted for.
#include <filesystem>

#include <gtest/gtest.h>

#include "engine/geometry/curve.h"
#include "engine/pipeline.h"
#include "engine/stages/import_pattern.h"
#include "tests/support/run_process.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

const std::string kFolder = std::string(TOILE_SOURCE_DIR) + "/schemas/examples/";

struct Example {
  const char* name;
  const char* wearer;
};
constexpr std::array<Example, 5> kExamples = {{{"a_line_skirt", "woman-38-168"},
                                               {"dress", "woman-38-168"},
                                               {"leggings", "child-128"},
                                               {"t_shirt", "man-50-178"},
                                               {"trousers", "man-50-178"}}};

Pattern read(const Example& example) {
  return import_pattern(test::read_file(kFolder + example.name + ".json"));
}

TEST(ShippedExamples, HaveSeamsOfEqualLengthButForTheSleevesEase) {
  constexpr double kDrawn = 1e-5, kLeastEase = 0.015, kMostEase = 0.025;  // m; of the armhole
  for (const Example& example : kExamples) {
    const Pattern pattern = read(example);
    int eased = 0;
    for (const Seam& seam : pattern.seams) {
      const double a = edge_length(pattern.panel(seam.a.panel), seam.a.edge),
                   b = edge_length(pattern.panel(seam.b.panel), seam.b.edge);
      if (pattern.edge(seam.a).name.ends_with("armhole")) {
        EXPECT_EQ(pattern.edge(seam.b).name, "cap");
        EXPECT_GT(b / a - 1.0, kLeastEase);
        EXPECT_LT(b / a - 1.0, kMostEase);
        ++eased;
      } else {
        EXPECT_NEAR(a, b, kDrawn) << example.name << " " << pattern.edge(seam.a).name;
      }
    }
    EXPECT_EQ(eased, std::string(example.name) == "t_shirt" ? 4 : 0);
  }
}

TEST(ShippedExamples, AreWhatTheDraftingProgramDraws) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "python3 is not installed";
  const test::TemporaryFolder folder;
  const test::ProcessResult run = test::run_process({"/usr/bin/python3", "-B", kFolder + "drafting", folder.path()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const Example& example : kExamples) {
    const std::string file = std::string("/") + example.name + ".json";
    EXPECT_EQ(test::read_file(folder.path() + file), test::read_file(kFolder + file)) << example.name;
  }
}

TEST(ShippedExamples, TheTrousersZipIsLockedAndTheirPocketsAreKeptOut) {
  const Pattern pattern = read(kExamples[4]);
  int zips = 0, pockets = 0;
  for (const Panel& panel : pattern.panels) {
    for (const PanelEdge& edge : panel.edges) zips += edge.zip && edge.locked;
    for (const KeepOut& region : panel.keep_outs) pockets += region.why == "patch pocket";
  }
  EXPECT_EQ(zips, 2);
  EXPECT_EQ(pockets, 2);
}

TEST(ShippedExamples, LieOnTheMannequinTheyWereDraftedFor) {
  constexpr double kClose = 0.10;  // p99 of the strain: leggings have no ease, the rest has
  for (const Example& example : kExamples) {
    AlterOptions options;
    options.triangles = 2000;
    StageRunner runner(nullptr, nullptr, kDrapeStages);
    const DrapedGarment worn =
        drape_garment({std::string(example.name) + ".json", test::read_file(kFolder + example.name + ".json")},
                      {.name = std::string("builtin:") + example.wearer, .bytes = {}}, options, runner)
            .value;
    const DrapeQuality& quality = worn.drape.quality;
    EXPECT_NE(quality.rest, Rest::NotAtRest) << example.name;
    EXPECT_EQ(quality.nodes_inside, 0) << example.name;
    EXPECT_EQ(quality.edges_inside, 0) << example.name;
    EXPECT_LT(std::max(quality.weft.p99, quality.warp.p99), kClose) << example.name;
    EXPECT_TRUE(worn.drape.diagnostics.findings.empty()) << example.name;
    EXPECT_EQ(worn.drape.diagnostics.rung, 0) << example.name;
  }
}

}  // namespace
}  // namespace toile
