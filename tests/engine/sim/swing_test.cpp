// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/swing.h"

#include <cmath>

#include <gtest/gtest.h>

namespace toile {
namespace {

Points3 moved_by(double x) {
  Points3 nodes = Points3::Zero(5, 3);
  nodes.col(0).setConstant(x);
  return nodes;
}

TEST(Swing, TellsWhatIsLeftOfAGeometricSeries) {
  Swing swing(moved_by(0));
  double left = 0;
  for (int round = 1; round <= 6; ++round) left = swing.after_round(moved_by(1 - std::pow(0.8, round)));
  EXPECT_NEAR(left, std::pow(0.8, 6), 1e-12);
}

TEST(Swing, IsWithoutEndWhileMovesGrowAndOverAtRest) {
  Swing swing(moved_by(0));
  EXPECT_TRUE(std::isinf(swing.after_round(moved_by(1))));
  EXPECT_TRUE(std::isinf(swing.after_round(moved_by(2.5))));
  EXPECT_EQ(swing.after_round(moved_by(2.5)), 0);
}

}  // namespace
}  // namespace toile
