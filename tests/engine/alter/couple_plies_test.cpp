// SPDX-License-Identifier: GPL-3.0-or-later
// Both plies of a seam after they are coupled: each vertex lies beside its partner.
#include "engine/alter/couple_plies.h"

#include <gtest/gtest.h>

#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using test::grid_garment;
using test::GridGarment;

constexpr double kLimit = 0.2;
constexpr double kApart = 1e-3;  // m: what the plies do for themselves
constexpr double kAlike = 1e-4;  // m

// Wanted longer in the upper half of the left panel and in the lower half of the right one, alike at the seam.
Vec2 bent(int panel, const Vec2& p) {
  const double share = panel == 0 ? p.x() / 0.4 : 1.0 - p.x() / 0.4;  // 1 at the seam
  const double own = panel == 0 ? std::max(0.0, p.y() - 0.3) : std::min(0.3, p.y());
  return {p.x(), p.y() + 0.12 * (1.0 - share) * own + 0.06 * share * p.y()};
}

double farthest_apart(const GridGarment& garment, const std::vector<Sheet>& sheets) {
  double farthest = 0.0;
  const auto height = [&](std::size_t panel, int vertex) {
    for (const SheetVertex& v : sheets[panel].vertices)
      if (v.origin == vertex) return v.now.y();
    return 1e9;
  };
  for (const auto& [a, b] : garment.mesh.seam_vertices[0])
    farthest = std::max(farthest, std::abs(height(0, a) - height(1, b)));
  return farthest;
}

struct Stretched {
  GridGarment garment =
      grid_garment({{"left", 0.4, 0.6, 20, 30, 0.2}, {"right", 0.4, 0.6, 20, 30, 0.2}}, {{0, 1, 1, 3}});
  Points2 wanted = garment.mapped(bent);
  std::vector<Sheet> sheets;

  Stretched() {
    for (int p = 0; p < 2; ++p) {
      sheets.push_back(make_sheet(garment.pattern, garment.mesh, garment.mesh.rest, wanted, p));
      relax(sheets.back());
    }
  }
  void couple(double limit) { couple_plies(garment.pattern, garment.mesh, wanted, limit, {}, sheets); }
};

TEST(CouplePlies, BringsTogetherWhatEveryPanelStretchesForItself) {
  Stretched panels;
  ASSERT_GT(farthest_apart(panels.garment, panels.sheets), kApart);
  panels.couple(kLimit);
  EXPECT_LT(farthest_apart(panels.garment, panels.sheets), kAlike);
}

TEST(CouplePlies, WhatIsRememberedLiesAsWhatIsHeldAnew) {
  Stretched alone, first, again;
  TearMemory memory(2);
  const auto couple = [&](Stretched& panels) {
    couple_plies(panels.garment.pattern, panels.garment.mesh, panels.wanted, kLimit, {}, panels.sheets, &memory);
  };
  alone.couple(kLimit);
  couple(first);
  ASSERT_EQ(memory[0].held.size(), 1u);
  couple(again);
  EXPECT_EQ(memory[0].held.size(), 1u);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_TRUE(lie_alike(first.sheets[p], alone.sheets[p])) << p;
    EXPECT_TRUE(lie_alike(again.sheets[p], alone.sheets[p])) << p;
  }
}

TEST(CouplePlies, ALockedPanelHoldsTheOther) {
  Stretched panels;
  panels.garment.pattern.panels[0].locked = true;
  const Sheet before = panels.sheets[0];
  panels.couple(kLimit);
  EXPECT_LT(farthest_apart(panels.garment, panels.sheets), kAlike);
  for (std::size_t v = 0; v < before.vertices.size(); ++v)
    EXPECT_EQ(before.vertices[v].now, panels.sheets[0].vertices[v].now);
}

}  // namespace
}  // namespace toile
