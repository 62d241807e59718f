// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "engine/stage_options.h"

namespace toile {
namespace {

AlterOptions preset(Preset name) {
  AlterOptions options;
  options.preset = name;
  return options;
}

TEST(Preset, FinerOnesStopAtASmallerResidual) {
  const auto residual = [](Preset name) { return drape_options_of(preset(name)).stop_residual; };
  EXPECT_GT(residual(Preset::Draft), residual(Preset::Standard));
  EXPECT_GT(residual(Preset::Standard), residual(Preset::Fine));
  EXPECT_EQ(residual(Preset::Standard), DrapeOptions().stop_residual);
}

TEST(Preset, ErrorIsToldOnlyWhereItWasMeasured) {
  AlterOptions options = preset(Preset::Standard);
  ASSERT_TRUE(measured_error(options));
  EXPECT_LT(measured_error(options)->stretch, measured_error(preset(Preset::Draft))->stretch);
  ASSERT_TRUE(measured_error(preset(Preset::Fine)));
  EXPECT_LT(measured_error(preset(Preset::Fine))->stretch, measured_error(options)->stretch);
  options.triangles = 3000;
  EXPECT_FALSE(measured_error(options));
}

}  // namespace
}  // namespace toile
