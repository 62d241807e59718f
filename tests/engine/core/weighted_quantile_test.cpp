// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/weighted_quantile.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

TEST(WeightedQuantile, CountsByWeightAndNotByNumber) {
  WeightedValues values = {{3, 1}, {1, 6}, {2, 3}};
  EXPECT_EQ(weighted_quantile(values, 0.5), 1);
  EXPECT_EQ(weighted_quantile(values, 0.61), 2);
  EXPECT_EQ(weighted_quantile(values, 0.9), 2);
  EXPECT_EQ(weighted_quantile(values, 0.91), 3);
  EXPECT_EQ(weighted_quantile(values, 1.0), 3);
}

TEST(WeightedQuantile, OfNothingIsZero) {
  WeightedValues none;
  EXPECT_EQ(weighted_quantile(none, 0.5), 0);
}

}  // namespace
}  // namespace toile
