// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "engine/geometry/inner_point.h"
#include "engine/geometry/shelf_layout.h"

namespace toile {
namespace {

TEST(ShelfLayout, RectanglesNeverOverlapAndStayOnTheSheet) {
  std::vector<Vec2> sizes;
  for (int i = 0; i < 40; ++i) sizes.emplace_back(10 + (i * 37) % 90, 5 + (i * 53) % 70);
  const double gap = 7;
  const ShelfLayout layout = lay_on_shelves(sizes, 250, gap);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_GE(layout.corners[i].minCoeff(), -1e-9);
    EXPECT_LE((layout.corners[i] + sizes[i] - layout.size).maxCoeff(), 1e-9);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 between =
          (layout.corners[i] - layout.corners[j] - sizes[j]).cwiseMax(layout.corners[j] - layout.corners[i] - sizes[i]);
      EXPECT_GE(between.maxCoeff(), gap - 1e-9) << i << " " << j;
    }
  }
}

TEST(ShelfLayout, NothingNeedsNoRoom) {
  EXPECT_EQ(lay_on_shelves({}, 100, 5).size, Vec2::Zero());
}

TEST(InnerPoint, TheMiddleOfASquareIsTheRoomiest) {
  const InnerPoint point = roomiest_point({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  EXPECT_NEAR(point.clearance, 5, 0.1);
  EXPECT_NEAR((point.at - Vec2(5, 5)).norm(), 0, 0.2);
}

TEST(InnerPoint, AnLShapeIsLabelledInsideItsThickerArm) {
  const std::vector<Vec2> shape = {{0, 0}, {100, 0}, {100, 10}, {30, 10}, {30, 100}, {0, 100}};
  const InnerPoint point = roomiest_point(shape);
  EXPECT_TRUE(inside_polygon(shape, point.at));
  EXPECT_GT(point.clearance, 14);
  const auto [down, up] = chord_through(shape, point.at, Vec2::UnitY());
  EXPECT_NEAR(up - down, 100, 1e-9);
}

TEST(InnerPoint, APolygonWithoutInsideHasNoRoom) {
  EXPECT_EQ(roomiest_point({}).clearance, 0);
  EXPECT_EQ(roomiest_point({{1, 1}, {2, 2}, {3, 3}}).clearance, 0);
}

}  // namespace
}  // namespace toile
