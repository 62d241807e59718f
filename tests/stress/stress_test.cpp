// SPDX-License-Identifier: GPL-3.0-or-later
// A short run of the stress suite, and every scene that once ended badly. The long run: toile-bench stress.
#include <tuple>

#include <gtest/gtest.h>

#include "engine/io/garmentcode_json.h"
#include "tests/stress/job_scene.h"
#include "tests/stress/stress_scene.h"

namespace toile::stress {
namespace {

std::string complaint(const Outcome& outcome, std::uint64_t seed) {
  std::string text = outcome.kind + " scene " + std::to_string(seed) + ", " + outcome.what + ":";
  for (const std::string& wrong : outcome.wrong) text += "\n  " + wrong;
  return text;
}

struct Share {
  const char* kind;
  int scenes;
};

class StressOf : public testing::TestWithParam<Share> {};

TEST_P(StressOf, RandomScenesEndWell) {
  const auto [kind, scenes] = GetParam();
  int done = 0;
  for (int i = 0; i < scenes; ++i) {
    const auto seed = static_cast<std::uint64_t>(i) + 1;
    const Outcome outcome = run_scene(kind, seed);
    EXPECT_NE(outcome.ending, Ending::Bad) << complaint(outcome, seed);
    done += outcome.ending == Ending::Done;
  }
  EXPECT_GT(3 * done, scenes) << "hardly any scene is done: the suite tests nothing";
}

INSTANTIATE_TEST_SUITE_P(Kinds, StressOf,
                         testing::Values(Share{"patchwork", 8}, Share{"person", 2}, Share{"body", 30}, Share{"cut", 10},
                                         Share{"derive", 30}),
                         [](const auto& kind) { return kind.param.kind; });

struct Fixture {
  const char* kind;
  std::uint64_t seed;
  const char* was;  // wrong
};

class StressFixture : public testing::TestWithParam<Fixture> {};

TEST_P(StressFixture, EndsWell) {
  const Outcome outcome = run_scene(GetParam().kind, GetParam().seed);
  EXPECT_NE(outcome.ending, Ending::Bad) << complaint(outcome, GetParam().seed) << "\nonce: " << GetParam().was;
}

INSTANTIATE_TEST_SUITE_P(
    Seeds, StressFixture,
    testing::Values(Fixture{"patchwork", 23, "a sliver became a target panel too small to be read back"},
                    Fixture{"patchwork", 184, "a sliver became a target panel too small to be read back"},
                    Fixture{"patchwork", 26, "curves drawn through the pieces' borders crossed each other"},
                    Fixture{"patchwork", 3385, "a narrow piece touched itself once it was drawn"},
                    Fixture{"patchwork", 3506, "a piece smaller than a panel may be"},
                    Fixture{"patchwork", 41186, "strips meshed as needles: their derived pattern was next to nothing"},
                    Fixture{"patchwork", 51181, "cloth tangled beyond mending was draped for a minute and a half"},
                    Fixture{"patchwork", 71282, "cloth that came to no rest was draped with ever firmer contact"},
                    Fixture{"cut", 20, "two corners of a piece fell into one: an edge of no length"},
                    Fixture{"cut", 1012, "a piece had a corner kilometres away"}),
    [](const auto& fixture) { return fixture.param.kind + std::to_string(fixture.param.seed); });

JobScene patchwork_of(std::uint64_t seed) {
  test::Dice dice = dice_of(seed);
  Outcome outcome;
  return patchwork_scene(dice, outcome);
}

GarmentInput garment_of(const JobScene& scene) {
  const std::string text = write_garmentcode(scene.pattern);
  return {"garment.json", Bytes(text.begin(), text.end())};
}

DrapeResult drape_of(const JobScene& scene) {
  StageRunner runner(nullptr, nullptr, kDrapeStages);
  return drape_garment(garment_of(scene), scene.reference, scene.options, runner).value.drape;
}

// A patchwork that folds through itself as it is draped.
TEST(Tangle, IsGivenUpOnceAndSaid) {
  const DrapeResult worn = drape_of(patchwork_of(51181));
  EXPECT_TRUE(worn.diagnostics.tangled);
  EXPECT_EQ(worn.quality.rest, Rest::NotAtRest);
  EXPECT_LT(worn.diagnostics.iterations, 1000) << "of 3,000 with every one of several contact stiffnesses";
  EXPECT_LT(worn.diagnostics.moved_nodes, 500) << "the whole was draped after its half";
  ASSERT_FALSE(worn.diagnostics.findings.empty());
  EXPECT_NE(worn.diagnostics.findings.back().message.find("tangled"), std::string::npos);
}

// Its half comes to no rest, pressed into the body.
TEST(Restless, IsDrapedAsAWholeInsteadOfFirmer) {
  const DrapeResult worn = drape_of(patchwork_of(71282));
  EXPECT_NE(worn.quality.rest, Rest::NotAtRest);
  EXPECT_LT(worn.diagnostics.iterations, 1000);
}

TEST(SlowRestless, FitIsWorthOneDerivation) {
  const JobScene scene = patchwork_of(61960);
  StageRunner runner(nullptr, nullptr, kDeriveStages);
  const DerivedGarment derived =
      derive_garment(garment_of(scene), scene.reference, scene.target, scene.options, runner).value;
  EXPECT_EQ(derived.reference.drape.quality.rest, Rest::NotAtRest);
  EXPECT_EQ(derived.derived.pass_errors.size(), 1u);
}

}  // namespace
}  // namespace toile::stress
