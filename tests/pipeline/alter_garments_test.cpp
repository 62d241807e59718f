// SPDX-License-Identifier: GPL-3.0-or-later
// Real garments altered for other bodies: what every alteration must be, whatever the target pattern.
#include <gtest/gtest.h>

#include "engine/pipeline.h"
#include "engine/stage_options.h"
#include "tests/support/count_tears.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

constexpr int kTriangles = 2000;
constexpr double kBalance = 0.015;  // strain that is left counts as area
constexpr double kAlike = 0.02;     // relative, of areas left and right

BodyInput shared_wearer(const std::string& name) {
  return {.name = name, .bytes = test::read_file(test::shared_data("bodies/" + name + ".obj"))};
}

DerivedGarment derive(const std::string& garment, const std::string& body, int triangles = kTriangles) {
  AlterOptions options;
  options.triangles = triangles;
  StageRunner runner(nullptr, nullptr, kDeriveStages);
  const std::string file = "garments/" + garment + "_specification.json";
  return derive_garment({garment, test::read_file(test::shared_data(file))},
                        shared_wearer(test::body_of_garment(garment)), shared_wearer(body), options, runner)
      .value;
}

AlterPatternResult alter(const DerivedGarment& derived, TearChoice choice) {
  AlterPatternOptions options = alter_options_of({});
  options.choice = choice;
  return alter_pattern(derived.reference.pattern, derived.reference.mesh, derived.derived.mesh.rest, options);
}

double changed_area(const AlterPatternResult& result, const std::string& prefix) {
  double sum = 0.0;
  for (const PanelAlteration& panel : result.panels)
    if (panel.panel.starts_with(prefix))
      for (const auto* regions : {&panel.insertions, &panel.removals})
        for (const AlteredRegion& region : *regions) sum += region.area;
  return sum;
}

class AlterGarments : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(AlterGarments, WithFewOperationsAlikeOnBothSidesAndNoClothAstray) {
  TOILE_REQUIRE_SHARED_DATA();
  const auto [garment, body] = GetParam();
  const DerivedGarment derived = derive(garment, body);
  const AlterPatternResult result = alter(derived, TearChoice::Release);
  ASSERT_FALSE(result.ticket.operations.empty());
  EXPECT_LE(result.ticket.operations.size(), alter(derived, TearChoice::Greedy).ticket.operations.size());
  EXPECT_LT(result.area_imbalance, kBalance);
  for (const std::string& flag : result.flags) EXPECT_EQ(flag.find("overlap"), std::string::npos) << flag;
  EXPECT_NEAR(changed_area(result, "left_"), changed_area(result, "right_"),
              kAlike * changed_area(result, "right_") + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Slow, AlterGarments,
                         testing::Values(std::pair{"m_tshirt", "ggg_large_male"},
                                         std::pair{"skirt_pencil", "ggg_small_female"}));

// Where so little stretch may stay sides alone do not do, or only many of them: a cut is cheaper until seams are
// preferred. Of one plan, as it is before it is tried on.
struct Preference {
  const char *garment, *body;
  double stretch_limit;
};

class AlterAlongSeams : public testing::TestWithParam<Preference> {};

TEST_P(AlterAlongSeams, AHigherPreferenceForSeamsCutsLess) {
  TOILE_REQUIRE_SHARED_DATA();
  const auto [garment, body, stretch_limit] = GetParam();
  const DerivedGarment derived = derive(garment, body, 4000);
  AlterPatternOptions options = alter_options_of({});
  options.stretch_limit = stretch_limit;
  const auto altered = [&](double gamma) {
    options.seam_preference = gamma;
    return alter_pattern(derived.reference.pattern, derived.reference.mesh, derived.derived.mesh.rest, options);
  };
  const AlterPatternResult cutting = altered(1.0), sewing = altered(3.0);
  EXPECT_GE(test::tears_of(cutting, TearKind::Edge), 1u);
  EXPECT_EQ(test::tears_of(sewing, TearKind::Edge), 0u);
  EXPECT_GT(test::tears_of(sewing, TearKind::Release), test::tears_of(cutting, TearKind::Release));
}

INSTANTIATE_TEST_SUITE_P(Slow, AlterAlongSeams,
                         testing::Values(Preference{"leggings_zero_ease", "ggg_large_male", 0.02},
                                         Preference{"sweater_loose_hood", "ggg_male_extra", 0.015},
                                         Preference{"pants_straight", "ggg_large_male", 0.02}));

}  // namespace
}  // namespace toile
