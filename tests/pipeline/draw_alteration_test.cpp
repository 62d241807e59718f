// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/draw_alteration.h"

#include <gtest/gtest.h>

#include "engine/geometry/inner_point.h"
#include "engine/geometry/offset_polygon.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using Map = std::function<Vec2(int panel, const Vec2&)>;

// Two panels of 400 x 600 mm sewn along one side; what is asked of the first one.
struct AlteredFront {
  test::GridGarment garment = test::grid_garment({{"front", 0.4, 0.6, 20, 30, 0.2}, {"back", 0.4, 0.6, 20, 30}});
  AlterPatternResult result;

  // With its sides locked the panel must be cut open.
  explicit AlteredFront(const Map& front, bool locked = false) {
    for (const std::size_t side : {std::size_t{1}, std::size_t{3}})
      garment.pattern.panels[0].edges[side].locked = locked;
    const auto map = [&](int panel, const Vec2& p) -> Vec2 { return panel == 0 ? front(panel, p) : p; };
    result = alter_pattern(garment.pattern, garment.mesh, garment.mapped(map), {});
  }
  Drawing draw() const { return draw_alteration(garment.pattern, result); }
};

Vec2 wider(int, const Vec2& p) {
  return {1.1 * p.x(), p.y()};
}
Vec2 narrower(int, const Vec2& p) {
  return {0.9 * p.x(), p.y()};
}

std::vector<DrawingLine> lines_of(const DrawingPiece& piece, LineKind kind) {
  std::vector<DrawingLine> lines;
  for (const DrawingLine& line : piece.lines)
    if (line.kind == kind) lines.push_back(line);
  return lines;
}

const DrawingPiece& piece_named(const Drawing& drawing, const std::string& name) {
  for (const DrawingPiece& piece : drawing.pieces)
    if (piece.name == name) return piece;
  throw std::runtime_error("no piece " + name);
}

TEST(DrawAlteration, EveryInsertionIsAPieceAndUnchangedPanelsStayAsTheyWere) {
  const Drawing drawing = AlteredFront(wider).draw();
  ASSERT_EQ(drawing.pieces.size(), 4u);
  EXPECT_EQ(drawing.pieces[0].name, "front");
  EXPECT_EQ(drawing.pieces[1].name, "front_as_sewn");
  EXPECT_EQ(drawing.pieces[1].role, PieceRole::Guide);
  EXPECT_EQ(drawing.pieces[2].role, PieceRole::Insertion);
  EXPECT_EQ(drawing.pieces[2].name, "front_insertion_1");
  EXPECT_EQ(drawing.pieces[3].name, "back");
  EXPECT_TRUE(lines_of(drawing.pieces[3], LineKind::Original).empty());
  EXPECT_NEAR(polygon_area(lines_of(drawing.pieces[3], LineKind::Cut).at(0).points), 420 * 620, 1);
}

TEST(DrawAlteration, CutAndStitchLineAreOneAllowanceApart) {
  const Drawing drawing = AlteredFront(wider, true).draw();
  int pieces = 0;
  for (const DrawingPiece& piece : drawing.pieces) {
    if (piece.role == PieceRole::Guide) continue;
    const auto cut = lines_of(piece, LineKind::Cut).at(0).points,
               stitch = lines_of(piece, LineKind::Stitch).at(0).points;
    for (std::size_t i = 0; i < cut.size(); ++i) {
      const Vec2 &a = cut[i], &b = cut[(i + 1) % cut.size()];
      if ((b - a).norm() > 60) {
        EXPECT_NEAR(distance_to_polygon(stitch, 0.5 * (a + b)), 10, 0.1) << piece.name;
      }
    }
    ++pieces;
  }
  EXPECT_GE(pieces, 3);
}

TEST(DrawAlteration, AnInsertionIsWiderByWhatTheCutClothTurnsIn) {
  const AlteredFront example(wider, true);
  ASSERT_EQ(example.result.panels[0].insertions.size(), 1u);
  const double open = example.result.panels[0].insertions[0].area * 1e6;
  const double piece =
      polygon_area(lines_of(piece_named(example.draw(), "front_insertion_1"), LineKind::Stitch).at(0).points);
  EXPECT_NEAR(piece - open, 2 * 10 * 600, 0.1 * 2 * 10 * 600);  // both lips along most of the panel
}

TEST(DrawAlteration, ATakenInPanelShowsWhatIsTakenAway) {
  const Drawing drawing = AlteredFront(narrower).draw();
  const DrawingPiece& front = piece_named(drawing, "front");
  EXPECT_EQ(lines_of(front, LineKind::Original).size(), 1u);
  ASSERT_EQ(lines_of(front, LineKind::Removal).size(), 1u);
  EXPECT_NEAR(polygon_area(lines_of(front, LineKind::Removal)[0].points), 40 * 600, 100);
  EXPECT_NEAR(polygon_area(lines_of(front, LineKind::Stitch).at(0).points), 360 * 600, 100);
}

TEST(DrawAlteration, TheGuideShowsInsertionsInTheirPlace) {
  const DrawingPiece guide = piece_named(AlteredFront(wider).draw(), "front_as_sewn");
  const auto insertions = lines_of(guide, LineKind::Insertion);
  ASSERT_EQ(insertions.size(), 1u);
  EXPECT_NEAR(polygon_area(insertions[0].points), 40 * 600, 50);
  EXPECT_NEAR(polygon_area(lines_of(guide, LineKind::Stitch).at(0).points), 440 * 600, 1);
}

}  // namespace
}  // namespace toile
