// SPDX-License-Identifier: GPL-3.0-or-later
// No foldovers: what is drawn can be cut, whatever the derivation asks for.
#include "engine/draw_target.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/stages/build_fitting_map.h"
#include "engine/stages/mesh_panels.h"
#include "engine/stages/outline_crossing.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

struct Sheet {
  Pattern pattern = test::grid_garment({{"sheet", 0.4, 0.6, 4, 6, 0.0}}).pattern;
  PatternMesh mesh = mesh_panels(pattern, {.triangles = 1500, .edge_length = {}});

  Drape lifted(double height) const {
    Drape drape;
    drape.nodes = Points3::Zero(mesh.node_count, 3);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const Vec2 p = mesh.rest.row(v);
      const double bump = height * std::exp(-((p - Vec2(0.2, 0.3)).squaredNorm()) / (0.08 * 0.08));
      drape.nodes.row(mesh.node_of_vertex[static_cast<std::size_t>(v)]) = Vec3(p.x(), p.y(), bump).transpose();
    }
    return drape;
  }
  FittingMap flat() const { return build_fitting_map(mesh, lifted(0.0)); }

  DrawnTarget draw(const Drape& shape, const Points2& derived) const {
    const FittingMap fit = flat();
    return draw_target(pattern, mesh, fit, shape, derived, {}, {}, nullptr);
  }
};

void expect_injective(const Sheet& sheet, const DrawnTarget& target) {
  EXPECT_EQ(target.inside.flipped_triangles, 0);
  for (const Panel& panel : target.drawn.pattern.panels) EXPECT_FALSE(find_outline_crossing(panel).has_value());
  const FittingMap usable = build_fitting_map(sheet.mesh, target.inside.rest, sheet.lifted(0.0));  // throws on flips
  EXPECT_EQ(usable.triangle_count(), sheet.mesh.triangle_count());
}

TEST(DrawTarget, FlattensBumpsThatTheLocalGlobalSolverFoldsOver) {
  const Sheet sheet;
  int folded = 0;
  for (const double height : {0.1, 0.25, 0.4}) {
    const Drape bump = sheet.lifted(height);
    const FittingMap fit = sheet.flat();
    const DerivePatternResult derived = derive_pattern(sheet.pattern, sheet.mesh, fit, bump);
    folded += derived.flipped_triangles;
    expect_injective(sheet, sheet.draw(bump, derived.rest));
  }
  EXPECT_GT(folded, 0) << "the case must be one";
}

TEST(DrawTarget, HoldsAPanelBackThatWouldCrossItself) {
  const Sheet sheet;
  Points2 crossed = sheet.mesh.rest;  // the lower half turned over: left and right sides cross in the middle
  for (int v = 0; v < crossed.rows(); ++v) {
    const double turn = std::clamp((crossed(v, 1) - 0.3) / 0.1, -1.0, 1.0);
    crossed(v, 0) = 0.2 + (crossed(v, 0) - 0.2) * turn;
  }
  const DrawnTarget target = sheet.draw(sheet.lifted(0.0), crossed);
  expect_injective(sheet, target);
  EXPECT_EQ(target.held_back, std::vector<int>{0});
  EXPECT_LT(target.kept_change, 1.0);
}

TEST(DrawTarget, KeepsTheWholeChangeWhereNothingIsWrong) {
  const Sheet sheet;
  const Points2 wider = 1.1 * sheet.mesh.rest;
  const DrawnTarget target = sheet.draw(sheet.lifted(0.0), wider);
  EXPECT_TRUE(target.held_back.empty());
  EXPECT_EQ(target.kept_change, 1.0);
  EXPECT_NEAR((target.drawn.pattern.panels[0].corners[1] - target.drawn.pattern.panels[0].corners[0]).norm(), 0.44,
              1e-9);
}

}  // namespace
}  // namespace toile
