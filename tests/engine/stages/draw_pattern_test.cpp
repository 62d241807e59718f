// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/draw_pattern.h"

#include <gtest/gtest.h>

#include "engine/core/drawing_marks.h"
#include "engine/core/units.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"
#include "engine/geometry/offset_polygon.h"
#include "engine/stages/import_pattern.h"
#include "tests/support/grid_garment.h"
#include "tests/support/shared_data.h"

namespace toile {
namespace {

const DrawingLine& line_of(const DrawingPiece& piece, LineKind kind) {
  for (const DrawingLine& line : piece.lines)
    if (line.kind == kind) return line;
  throw std::runtime_error("no such line");
}

Pattern two_rectangles() {
  Pattern pattern = test::grid_garment({{"front", 0.4, 0.6}, {"back", 0.4, 0.6}}, {{0, 1, 1, 3}}).pattern;
  pattern.seam_allowance = 0.015;
  return pattern;
}

TEST(DrawPattern, TheCutLineOfARectangleIsTheStitchLinePlusAllowance) {
  const Drawing drawing = draw_pattern(two_rectangles());
  ASSERT_EQ(drawing.pieces.size(), 2u);
  EXPECT_NEAR(polygon_area(line_of(drawing.pieces[0], LineKind::Stitch).points), 400 * 600, 1e-6);
  EXPECT_NEAR(polygon_area(line_of(drawing.pieces[0], LineKind::Cut).points), 430 * 630, 1e-6);
}

TEST(DrawPattern, FoldsGetNoAllowanceHemsTheirDepthEdgesTheirOwn) {
  Pattern pattern = two_rectangles();
  pattern.panels[0].edges[3].on_fold = true;
  pattern.panels[0].edges[0].hem = 0.04;
  pattern.panels[0].edges[2].seam_allowance = 0.005;
  const DrawingPiece piece = draw_pattern(pattern).pieces[0];
  const DrawingLine& cut = line_of(piece, LineKind::Cut);
  Vec2 low = cut.points[0], high = low;
  for (const Vec2& p : cut.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  EXPECT_NEAR((low - Vec2(0, -40)).norm(), 0, 1e-9);
  EXPECT_NEAR((high - Vec2(415, 605)).norm(), 0, 1e-9);
  const DrawingLine& fold = line_of(piece, LineKind::Fold);
  ASSERT_EQ(fold.points.size(), 2u);
  EXPECT_NEAR(fold.points[0].y() + fold.points[1].y(), 0, 1e-9);  // the hem's fold comes first: edge 0
}

TEST(DrawPattern, ClockwisePanelsAreDrawnWithTheAllowanceOutside) {
  Pattern pattern = two_rectangles();
  Panel& panel = pattern.panels[0];
  std::reverse(panel.corners.begin(), panel.corners.end());
  panel.edges[1].seam_allowance = 0.03;
  const DrawingPiece piece = draw_pattern(pattern).pieces[0];
  EXPECT_NEAR(polygon_area(line_of(piece, LineKind::Stitch).points), 400 * 600, 1e-6);
  // Edge 1 of the reversed outline runs along the top from right to left of the file's corners.
  const Vec2 middle = 500.0 * (panel.edge_start(1) + panel.edge_end(1));
  EXPECT_NEAR(distance_to_polygon(line_of(piece, LineKind::Cut).points, middle), 30, 1e-9);
}

TEST(DrawPattern, ANotchStandsOnTheCutLineAndPointsInside) {
  Pattern pattern = two_rectangles();
  pattern.panels[0].notches = {{1, 0.25, NotchType::T}};
  const DrawingPiece piece = draw_pattern(pattern).pieces[0];
  ASSERT_EQ(piece.notches.size(), 1u);
  EXPECT_NEAR((piece.notches[0].at - Vec2(415, 150)).norm(), 0, 1e-6);
  EXPECT_NEAR((piece.notches[0].on_stitch - Vec2(400, 150)).norm(), 0, 1e-6);
  EXPECT_NEAR((piece.notches[0].inward - Vec2(-1, 0)).norm(), 0, 1e-9);
  for (const Vec2& p : notch_outline(piece.notches[0])) EXPECT_LE(p.x(), 415 + 1e-9);
}

TEST(DrawPattern, BothSidesOfASeamCarryItsNumberInside) {
  const Drawing drawing = draw_pattern(two_rectangles());
  for (const DrawingPiece& piece : drawing.pieces) {
    int found = 0;
    for (const DrawingText& text : piece.texts) {
      if (text.text != "1") continue;
      ++found;
      EXPECT_TRUE(inside_polygon(line_of(piece, LineKind::Stitch).points, text.at));
    }
    EXPECT_EQ(found, 1);
  }
}

TEST(DrawPattern, ANarrowDartIsFoldedAndAWideOneCut) {
  Pattern pattern = two_rectangles();
  Panel& panel = pattern.panels[0];
  for (const double mouth : {0.03, 0.08}) {
    panel.corners = {{0, 0},  {0.4, 0}, {0.4, 0.6}, {0.2 + mouth / 2, 0.6}, {0.2, 0.3}, {0.2 - mouth / 2, 0.6},
                     {0, 0.6}};
    panel.edges.assign(7, PanelEdge{});
    pattern.seams = {{{PanelId(0), 3}, {PanelId(0), 4}, false}};
    const DrawingLine cut = line_of(draw_pattern(pattern).pieces[0], LineKind::Cut);
    const double whole = 430.0 * 630.0;
    if (mouth < 0.05)
      EXPECT_NEAR(polygon_area(cut.points), whole, 1e-6);
    else
      EXPECT_LT(polygon_area(cut.points), whole - 1000);
  }
}

TEST(DrawPattern, ChangesAreWrittenInMillimetres) {
  const Pattern original = two_rectangles();
  Pattern changed = original;
  changed.panels[0].corners[2].x() += 0.012;
  const Drawing drawing = draw_changes(original, changed);
  EXPECT_NEAR(polygon_area(line_of(drawing.pieces[0], LineKind::Original).points), 400 * 600, 1e-6);
  const auto says = [](const DrawingPiece& piece, const std::string& words) {
    return std::any_of(piece.texts.begin(), piece.texts.end(), [&](const auto& t) { return t.text == words; });
  };
  EXPECT_TRUE(says(drawing.pieces[0], "+12.0 mm"));
  EXPECT_FALSE(says(drawing.pieces[1], "+12.0 mm"));
}

// Every garment: the cut line keeps the allowance from every sewn or free edge that is not a folded dart.
TEST(DrawPattern, CutMinusStitchIsTheAllowanceOnEveryRealGarment) {
  TOILE_REQUIRE_SHARED_DATA();
  for (const std::string& name : test::shared_garment_names()) {
    const Pattern pattern =
        import_pattern(test::read_file(test::shared_data("garments/" + name + "_specification.json")));
    const double allowance = pattern.seam_allowance * kMmPerMetre;
    DrawPatternOptions options;
    options.folded_dart_mm = 0;
    for (const DrawingPiece& piece : draw_pattern(pattern, options).pieces) {
      const auto& stitch = line_of(piece, LineKind::Stitch).points;
      const auto& cut = line_of(piece, LineKind::Cut).points;
      double nearest = 1e300;
      for (const Vec2& p : stitch) nearest = std::min(nearest, distance_to_polygon(cut, p));
      EXPECT_NEAR(nearest, allowance, 0.05) << name << " " << piece.name;
      for (const Vec2& p : cut) {
        EXPECT_GE(distance_to_polygon(stitch, p), allowance - 0.1) << name << " " << piece.name;
        EXPECT_LE(distance_to_polygon(stitch, p), 3 * allowance * 1.2) << name << " " << piece.name;
      }
    }
  }
}

}  // namespace
}  // namespace toile
