// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/stretch.h"

#include <gtest/gtest.h>

#include "engine/alter/lay_sheet.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

// A square whose wanted outline is wider at the top than cloth can be without stress.
Vec2 widened(const Vec2& p) {
  return {p.x() * (1.0 + 0.5 * p.y()), p.y()};
}

Sheet square(int cells) {
  const test::GridGarment garment = test::grid_garment({{"square", 0.4, 0.4, cells, cells, 0.0}});
  const Points2 wanted = garment.mapped([](int, const Vec2& p) { return widened(p); });
  return make_sheet(garment.pattern, garment.mesh, garment.mesh.rest, wanted, 0);
}

void let_go(Sheet& sheet, int side) {
  for (SheetVertex& vertex : sheet.vertices)
    if (SheetAnchor* anchor = vertex.anchor(side)) anchor->attached = false;
}

double largest_move(const Sheet& a, const Sheet& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    largest = std::max(largest, (a.vertices[v].now - b.vertices[v].now).norm());
  return largest;
}

TEST(Stretch, SharedEquationsRelaxACopyAsItsOwnWould) {
  const RelaxOptions options;
  Sheet sheet = square(10);
  relax(sheet, options);
  SheetEquations shared(sheet, options.hold);
  Sheet copy = sheet, own = sheet;
  for (Sheet* released : {&copy, &own}) let_go(*released, 1);
  relax(copy, options, nullptr, &shared);
  relax(own, options);
  EXPECT_GT(largest_move(copy, sheet), 1e-3);
  EXPECT_EQ(largest_move(copy, own), 0.0);
}

TEST(Stretch, ClothThatIsLetGoLosesItsStress) {
  Sheet sheet = square(10);
  relax(sheet);
  const SheetStress held = measure_stress(sheet);
  ASSERT_GT(held.p95, 0.03);
  for (int side = 0; side < static_cast<int>(sheet.sides.size()); ++side) let_go(sheet, side);
  relax(sheet, {.max_renewals = 60, .energy_drop = 1e-8});
  EXPECT_LT(measure_stress(sheet).p95, 0.1 * held.p95);
}

TEST(LaySheet, AFineSheetBeginsNearWhereItEnds) {
  Sheet coarse = square(6), fine = square(18);
  for (Sheet* sheet : {&coarse, &fine}) let_go(*sheet, 1);
  relax(coarse);
  Sheet relaxed = fine;
  const RelaxOptions to_the_end = {.max_renewals = 200, .energy_drop = 1e-9};
  relax(relaxed, to_the_end);
  const double from_plain = largest_move(fine, relaxed);
  ASSERT_GT(from_plain, 5e-3);
  lay_like(fine, coarse);
  EXPECT_LT(largest_move(fine, relaxed), 0.2 * from_plain);
}

}  // namespace
}  // namespace toile
