// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_alteration.h"

#include <gtest/gtest.h>

#include "engine/geometry/inner_point.h"
#include "engine/geometry/offset_polygon.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

std::vector<Vec2> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// A panel of 400 x 600 mm widened by a strip of 30 mm at x = 200, and narrowed by 20 mm at its right edge.
struct Example {
  Pattern pattern = test::grid_garment({{"front", 0.4, 0.6, 4, 6}, {"back", 0.4, 0.6, 4, 6}}, {{0, 1, 1, 3}}).pattern;
  AlterPatternResult result;

  Example() {
    PanelAlteration front;
    front.panel = "front";
    front.original = rectangle(0, 0, 0.4, 0.6);
    front.target = rectangle(0, 0, 0.41, 0.6);
    front.kept = {{rectangle(0, 0, 0.2, 0.6), {}}, {rectangle(0.2, 0, 0.38, 0.6), {}}};
    // A spike along the hem, as booleans leave it.
    front.kept[1].outline.insert(front.kept[1].outline.begin() + 1, {Vec2(0.38, 0.0002), Vec2(0.4, 0.0001)});
    std::swap(front.kept[1].outline[1], front.kept[1].outline[2]);
    front.cut_lines = {{{0.2, 0.0}, {0.2, 0.6}}};
    front.kept_in_target = {rectangle(0, 0, 0.2, 0.6), rectangle(0.23, 0, 0.41, 0.6)};
    front.insertions = {{"front_insertion_1", {rectangle(0.2, 0, 0.23, 0.6), {}}, 0.018, 0}};
    front.removals = {{"front_removal_1", {rectangle(0.38, 0, 0.4, 0.6), {}}, 0.012, 1}};
    MadeTear tear;
    tear.release = 0.5, tear.largest_gap = 0.03;
    front.insertion_pass.tears = {tear};
    PanelAlteration back;
    back.panel = "back";
    result.panels = {front, back};
  }
};

std::vector<DrawingLine> lines_of(const DrawingPiece& piece, LineKind kind) {
  std::vector<DrawingLine> lines;
  for (const DrawingLine& line : piece.lines)
    if (line.kind == kind) lines.push_back(line);
  return lines;
}

TEST(DrawAlteration, EveryInsertionIsAPieceAndUnchangedPanelsStayAsTheyWere) {
  const Example example;
  const Drawing drawing = draw_alteration(example.pattern, example.result);
  ASSERT_EQ(drawing.pieces.size(), 4u);
  EXPECT_EQ(drawing.pieces[0].name, "front");
  EXPECT_EQ(drawing.pieces[1].role, PieceRole::Guide);
  EXPECT_EQ(drawing.pieces[2].role, PieceRole::Insertion);
  EXPECT_EQ(drawing.pieces[2].name, "front_insertion_1");
  EXPECT_EQ(drawing.pieces[3].name, "back");
  EXPECT_EQ(lines_of(drawing.pieces[3], LineKind::Cut).size(), 1u);
}

TEST(DrawAlteration, AnInsertionGivesTwiceTheAllowanceWhereItMeetsCutCloth) {
  const Example example;
  const DrawingPiece piece = draw_alteration(example.pattern, example.result).pieces[2];
  const auto cut = lines_of(piece, LineKind::Cut).at(0).points;
  // Allowance 10 mm: 20 at both long sides, 10 at both ends.
  EXPECT_NEAR(polygon_area(cut), (30 + 40) * (600 + 20), 1e-6);
  ASSERT_EQ(piece.notches.size(), 2u);
  for (const DrawingNotch& notch : piece.notches) {
    EXPECT_NEAR(notch.on_stitch.y(), 300, 1e-6);
    EXPECT_TRUE(inside_polygon(cut, notch.at + notch.depth * notch.inward));
    EXPECT_NEAR((notch.at - notch.on_stitch).norm(), 20, 1e-6);
  }
}

TEST(DrawAlteration, KeptClothLosesItsSpikesAndHasNoAllowanceAtTheCut) {
  const Example example;
  const DrawingPiece piece = draw_alteration(example.pattern, example.result).pieces[0];
  const auto cuts = lines_of(piece, LineKind::Cut);
  ASSERT_EQ(cuts.size(), 2u);
  EXPECT_NEAR(polygon_area(cuts[0].points), (200 + 10) * 620, 1);
  EXPECT_NEAR(polygon_area(cuts[1].points), (180 + 10) * 620, 1);
  EXPECT_EQ(lines_of(piece, LineKind::Removal).size(), 1u);
  const auto let_in = lines_of(piece, LineKind::Insertion);
  ASSERT_EQ(let_in.size(), 1u);
  EXPECT_FALSE(let_in[0].closed);
  EXPECT_EQ(piece.notches.size(), 2u);
}

TEST(DrawAlteration, TheGuideShowsInsertionsInTheirPlace) {
  const Example example;
  const DrawingPiece guide = draw_alteration(example.pattern, example.result).pieces[1];
  const auto insertions = lines_of(guide, LineKind::Insertion);
  ASSERT_EQ(insertions.size(), 1u);
  EXPECT_NEAR(polygon_area(insertions[0].points), 30 * 600, 1e-6);
  EXPECT_NEAR(polygon_area(lines_of(guide, LineKind::Stitch).at(0).points), 410 * 600, 1e-6);
}

TEST(DrawAlteration, TearsAreListedForAlteredPanelsOnly) {
  const Example example;
  const Drawing tears = draw_tears(example.pattern, example.result);
  ASSERT_EQ(tears.pieces.size(), 1u);
  ASSERT_EQ(tears.pieces[0].texts.size(), 2u);
  EXPECT_NE(tears.pieces[0].texts[1].text.find("30.0 mm open, releases 50 %"), std::string::npos);
}

}  // namespace
}  // namespace toile
