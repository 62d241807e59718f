// SPDX-License-Identifier: GPL-3.0-or-later
// A panel whose cloth lies alike in two plans is cut once, and its pieces with it.
#include "engine/alter/cut_panel.h"

#include <gtest/gtest.h>

#include "engine/alter/sew_altered.h"
#include "engine/alter/tear_pattern.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using test::grid_garment;
using test::GridGarment;

struct Widened {
  GridGarment garment = grid_garment({{"front", 0.4, 0.6, 10, 15, 0.2}});
  Points2 wanted = garment.mapped([](int, const Vec2& p) { return Vec2(1.2 * p.x(), p.y()); });
  TornPattern inserting = torn(garment.mesh.rest, wanted), removing = torn(wanted, garment.mesh.rest);
  std::list<CutPanel> known;

  TornPattern torn(const Points2& from, const Points2& to) const {
    TearMemory memory;
    const Stretching both{garment.mesh, from, to};
    return tear_pattern(garment.pattern, both, both, {}, memory);
  }
  CutPanel& cut(const Sheet& insertion) {
    return cut_panel(garment.pattern, garment.mesh, wanted, 0, insertion, removing.sheets[0], {}, known);
  }
};

TEST(CutPanel, ClothThatLiesAlikeIsCutOnce) {
  Widened widened;
  const CutPanel& first = widened.cut(widened.inserting.sheets[0]);
  EXPECT_FALSE(first.alteration.insertions.empty());
  EXPECT_EQ(&widened.cut(Sheet(widened.inserting.sheets[0])), &first);
}

TEST(CutPanel, ClothThatLiesElsewhereIsCutForItself) {
  Widened widened;
  const CutPanel& first = widened.cut(widened.inserting.sheets[0]);
  Sheet moved = widened.inserting.sheets[0];
  for (SheetVertex& vertex : moved.vertices)
    if (vertex.anchors[0].side < 0) vertex.now.x() += 1e-6;
  EXPECT_NE(&widened.cut(moved), &first);
  EXPECT_EQ(widened.known.size(), 2u);
}

TEST(CutPanel, PiecesAreKnownForTheSameRegionsOnly) {
  Widened widened;
  CutPanel& panel = widened.cut(widened.inserting.sheets[0]);
  AlterPatternResult result;
  result.panels = {panel.alteration};
  RecutPanels recut;
  SewMemory memory;
  const auto sewn = [&] {
    return sew_altered(widened.garment.pattern, widened.garment.mesh, widened.wanted, {&panel}, result, recut, memory);
  };
  const SewnPattern first = sewn();
  const std::size_t drawn = memory.drawn.size(), trued = memory.trued.size();
  EXPECT_GT(drawn, 0u);
  const SewnPattern again = sewn();
  EXPECT_EQ(panel.pieces.size(), 1u);
  EXPECT_EQ(memory.drawn.size(), drawn);
  EXPECT_EQ(memory.trued.size(), trued);
  ASSERT_EQ(first.pieces.size(), again.pieces.size());
  ASSERT_GT(first.pieces.size(), 1u);
  for (std::size_t i = 0; i < first.pieces.size(); ++i)
    EXPECT_TRUE(first.pieces[i].map.rest == again.pieces[i].map.rest) << i;
  result.panels[0].insertions.clear();  // as where its tear turns out to open nothing
  EXPECT_LT(sewn().pieces.size(), first.pieces.size());
  EXPECT_EQ(panel.pieces.size(), 2u);
}

}  // namespace
}  // namespace toile
