// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/label_room.h"

#include <gtest/gtest.h>

#include "engine/render/stroke_font.h"

namespace toile {
namespace {

TEST(LabelRoom, OfTwoThatOverlapTheLongerOneStays) {
  const Label number{{100, 100}, 10, "12", 0}, name{{104, 103}, 10, "front", 0}, far{{100, 140}, 10, "13", 0};
  EXPECT_EQ(labels_with_room({number, name, far}), (std::vector<bool>{false, true, true}));
  EXPECT_EQ(labels_with_room({number, number}), (std::vector<bool>{true, false}));
  EXPECT_TRUE(labels_with_room({}).empty());
}

TEST(LabelRoom, ATurnedLabelTakesTheRoomItIsDrawnIn) {
  const double width = text_width("a long name", 10), up = 1.5707963267948966;
  const Label lying{{100, 100}, 10, "a long name", 0}, standing{{100, 100}, 10, "a long name", up};
  // Above the middle: free of the lying words, in the midst of the standing ones.
  const Label above{{96, 100 - 0.4 * width}, 10, "1", 0};
  EXPECT_EQ(labels_with_room({lying, above}), (std::vector<bool>{true, true}));
  EXPECT_EQ(labels_with_room({standing, above}), (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace toile
