// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts along mesh edges: always through, and the smoother the less they heed the wanted direction at every edge.
#include "engine/alter/cut_sheet.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/alter/propagate_tear.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

const Vec2 kOblique = Vec2(0.35, 1.0).normalized();

Sheet irregular_sheet() {
  const test::GridGarment garment = test::grid_garment({{"front", 0.4, 0.6, 20, 30, 0.25}});
  return make_sheet(garment.pattern, garment.mesh, garment.mesh.rest, garment.mesh.rest, 0);
}

std::vector<Vec2> way_of_cut(double smoothness) {
  Sheet sheet = irregular_sheet();
  std::vector<Vec2> way;
  if (!cut_along_edges(sheet, vertex_on_side(sheet, 0, 0.2), kOblique, smoothness)) return way;
  for (const auto& lips : sheet.cuts.back().lips)
    way.push_back(sheet.vertices[static_cast<std::size_t>(lips.first)].flat);
  return way;
}

int bends(const std::vector<Vec2>& way) {
  int count = 0;
  for (std::size_t i = 2; i < way.size(); ++i) {
    const Vec2 in = way[i - 1] - way[i - 2], out = way[i] - way[i - 1];
    count += std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out))) > 0.5;
  }
  return count;
}

TEST(CutSheet, GoesThroughAtEverySmoothness) {
  for (const double smoothness : {0.0, 0.25, 0.5, 0.75, 1.0})
    EXPECT_GT(way_of_cut(smoothness).size(), 5u) << smoothness;
}

TEST(CutSheet, SmoothnessTakesBendsAway) {
  EXPECT_LT(bends(way_of_cut(0.5)), bends(way_of_cut(0.0)));
}

}  // namespace
}  // namespace toile
