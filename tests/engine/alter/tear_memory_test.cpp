// SPDX-License-Identifier: GPL-3.0-or-later
// Plans with less of the allowed stretch look up what earlier ones have found out, and come out as they would alone.
#include "engine/alter/tear_memory.h"

#include <gtest/gtest.h>

#include "engine/alter/tear_pattern.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using test::grid_garment;
using test::GridGarment;

constexpr double kAllowed = 0.05, kLess = 0.03;

struct Widened {
  GridGarment garment =
      grid_garment({{"left", 0.4, 0.6, 10, 15, 0.2}, {"right", 0.4, 0.6, 10, 15, 0.2}}, {{0, 1, 1, 3}});
  Points2 wanted = garment.mapped(
      [](int panel, const Vec2& p) { return Vec2(p.x() * (panel == 0 ? 1.2 : 1.04), p.y() * (1.0 + 0.3 * p.x())); });

  TornPattern tear(double limit, TearMemory& memory) const {
    TearPatternOptions options;
    options.candidates.stretch_limit = limit;
    const Stretching both{garment.mesh, garment.mesh.rest, wanted};
    return tear_pattern(garment.pattern, both, both, options, memory);
  }
};

std::size_t tried(const TearMemory& memory) {
  std::size_t sum = 0;
  for (const PanelMemory& panel : memory) sum += panel.tried[0].size() + panel.tried[1].size();
  return sum;
}

TEST(TearMemory, APlanWithLessStretchIsWhatItWouldBeAlone) {
  const Widened widened;
  TearMemory fresh, shared;
  const TornPattern alone = widened.tear(kLess, fresh);
  widened.tear(kAllowed, shared);
  const std::size_t before = tried(shared);
  ASSERT_GT(before, 0u);
  const TornPattern after = widened.tear(kLess, shared);
  EXPECT_LT(tried(shared) - before, static_cast<std::size_t>(after.trials));  // some were looked up
  EXPECT_EQ(after.trials, alone.trials);
  EXPECT_EQ(after.jobs, alone.jobs);
  for (std::size_t p = 0; p < alone.sheets.size(); ++p) {
    EXPECT_TRUE(lie_alike(after.sheets[p], alone.sheets[p])) << p;
    EXPECT_EQ(after.panels[p].after.energy, alone.panels[p].after.energy) << p;
  }
}

TEST(TearMemory, TheSamePlanFindsNothingNew) {
  const Widened widened;
  TearMemory memory;
  const TornPattern first = widened.tear(kAllowed, memory);
  const std::size_t sets = tried(memory), carried = memory[0].carried_out.size(), held = memory[0].held.size();
  ASSERT_GT(sets * carried, 0u);
  const TornPattern again = widened.tear(kAllowed, memory);
  EXPECT_EQ(again.trials, first.trials);
  EXPECT_EQ(tried(memory), sets);
  EXPECT_EQ(memory[0].carried_out.size(), carried);
  EXPECT_EQ(memory[0].held.size(), held);
}

TEST(TearMemory, SheetsThatLieElsewhereAreNotAlike) {
  const Widened widened;
  TearMemory memory;
  Sheet sheet = widened.tear(kAllowed, memory).sheets[0];
  const Sheet before = sheet;
  EXPECT_TRUE(lie_alike(before, sheet));
  sheet.vertices.back().now.x() += 1e-12;
  EXPECT_FALSE(lie_alike(before, sheet));
  sheet = before;
  sheet.vertices.front().anchors[0].attached = !sheet.vertices.front().anchors[0].attached;
  EXPECT_FALSE(lie_alike(before, sheet));
}

}  // namespace
}  // namespace toile
