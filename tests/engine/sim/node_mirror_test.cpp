// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/node_mirror.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

TEST(NodeMirror, SymmetriseProjectsOntoSymmetricPositions) {
  const NodeMirror mirror = {{1, 0, 2}, {1, -1, 0}};
  Points3 rows(3, 3);
  rows << 1, 2, 3, -3, 4, 5, 0.5, 6, 7;
  symmetrise(mirror, rows);
  Points3 wanted(3, 3);
  wanted << 2, 3, 4, -2, 3, 4, 0, 6, 7;
  EXPECT_EQ(rows, wanted);
  const Points3 once = rows;
  symmetrise(mirror, rows);
  EXPECT_EQ(rows, once);
}

}  // namespace
}  // namespace toile
