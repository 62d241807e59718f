// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_tears.h"

#include <gtest/gtest.h>

#include "tests/support/grid_garment.h"

namespace toile {
namespace {

// Two panels of 400 x 600 mm of which the first is to be wider and longer.
TearDrawing example() {
  const test::GridGarment garment = test::grid_garment({{"front", 0.4, 0.6, 20, 30, 0.2}, {"back", 0.4, 0.6, 20, 30}});
  const Points2 wanted = garment.mapped(
      [](int panel, const Vec2& p) -> Vec2 { return panel == 0 ? Vec2(1.05 * p.x(), 1.05 * p.y()) : p; });
  const AlterPatternResult result = alter_pattern(garment.pattern, garment.mesh, wanted, {});
  return draw_tears(garment.pattern, garment.mesh, wanted, result, {});
}

double mean_red(const PiecePaint& paint) {
  double sum = 0.0;
  for (const Rgb& colour : paint.colours) sum += colour.r;
  return sum / static_cast<double>(paint.colours.size());
}

TEST(DrawTears, AFrameShowsThePanelBeforeAndAfterEveryRound) {
  const TearDrawing tears = example();
  ASSERT_EQ(tears.drawing.pieces.size(), 3u);
  EXPECT_EQ(tears.drawing.pieces[0].name, "front_insert_0");
  EXPECT_EQ(tears.drawing.pieces[1].name, "front_insert_1");
  EXPECT_EQ(tears.drawing.pieces[2].name, "front_insert_2");
  EXPECT_NE(tears.drawing.pieces[1].texts.at(2).text.find(" mm, releases "), std::string::npos);
}

TEST(DrawTears, TheLastRoundLeavesTheClothWithoutStretch) {
  const TearDrawing tears = example();
  ASSERT_EQ(tears.paint.size(), 3u);
  EXPECT_GT(mean_red(tears.paint[0]), mean_red(tears.paint[2]) + 50.0);
  for (const Rgb& colour : tears.paint[2].colours) EXPECT_GT(colour.g, colour.r);
}

TEST(DrawTears, FramesAreOfOneHeightSoThatTheyKeepTheirOrder) {
  const TearDrawing tears = example();
  for (const DrawingPiece& piece : tears.drawing.pieces) {
    const auto [low, high] = bounds(piece);
    const auto [first_low, first_high] = bounds(tears.drawing.pieces[0]);
    EXPECT_NEAR(high.y() - low.y(), first_high.y() - first_low.y(), 1e-6) << piece.name;
  }
}

}  // namespace
}  // namespace toile
