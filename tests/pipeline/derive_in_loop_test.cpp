// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/derive_in_loop.h"

#include <gtest/gtest.h>

#include "engine/pipeline.h"
#include "engine/stage_options.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

// A skirt drafted for one woman, derived for a larger one.
class DeriveInLoop : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    options_.triangles = 1500;
    const std::string path = std::string(TOILE_SOURCE_DIR) + "/schemas/examples/a_line_skirt.json";
    StageRunner runner(nullptr, nullptr, kAlterStages);
    garment_ =
        derive_garment({"a_line_skirt.json", test::read_file(path)}, {.name = "builtin:woman-38-168", .bytes = {}},
                       {.name = "builtin:woman-46-175", .bytes = {}}, options_, runner)
            .value;
  }
  static void TearDownTestSuite() { garment_.reset(); }

  static DerivedPattern derive(const DeriveInLoopOptions& loop) {
    DrapeSeries on_target(garment_->target_body);
    return derive_in_loop(garment_->reference.pattern, garment_->reference.mesh, garment_->reference.fit, on_target,
                          garment_->transported.drape, {}, derive_options_of(options_), drape_options_of(options_),
                          loop);
  }

  static inline AlterOptions options_;
  static inline std::optional<DerivedGarment> garment_;
};

TEST_F(DeriveInLoop, TriesNoFurtherPassWhereTheFirstIsGoodEnough) {
  EXPECT_EQ(derive({.good_enough = 1.0}).pass_errors.size(), 1u);
}

TEST_F(DeriveInLoop, KeepsThePassNearestToTheReference) {
  const DerivedPattern kept = derive({.good_enough = 0.0, .least_gain = 0.0});
  ASSERT_GE(kept.pass_errors.size(), 2u);
  EXPECT_EQ(kept.rms_stretch_error, *std::min_element(kept.pass_errors.begin(), kept.pass_errors.end()));
  EXPECT_LT(kept.rms_stretch_error, kept.pass_errors.front());
}

TEST_F(DeriveInLoop, KeepsALaterPassOnlyWhereItIsAsMuchNearerAsAsked) {
  const DerivedPattern any = derive({.good_enough = 0.0, .least_gain = 0.0});
  const double nearer = 1.0 - any.rms_stretch_error / any.pass_errors.front();
  ASSERT_GT(nearer, 0.0);
  const DerivedPattern first = derive({.good_enough = 0.0, .least_gain = 0.0, .least_nearer = nearer + 0.01});
  EXPECT_EQ(first.rms_stretch_error, first.pass_errors.front());
}

TEST_F(DeriveInLoop, TriesNoPassTwice) {
  const DerivedPattern first = derive({.good_enough = 0.0, .least_gain = -1.0, .least_nearer = 1.0});
  EXPECT_EQ(first.pass_errors.size(), 2u) << "the second was not kept: a third would begin where it began";
}

}  // namespace
}  // namespace toile
