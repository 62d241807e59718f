// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/unfold_triangles.h"

#include <gtest/gtest.h>

#include "tests/support/grid_garment.h"

namespace toile {
namespace {

constexpr double kLeast = 0.05;

struct Sheet {
  PatternMesh mesh;
  TriangleGradients gradients;
  std::vector<bool> border;
};

Sheet sheet() {
  Sheet s;
  s.mesh = test::grid_garment({{"sheet", 0.4, 0.4, 12, 12, 0.2}}).mesh;
  s.gradients = triangle_gradients(s.mesh.rest, s.mesh.triangles);
  s.border.assign(static_cast<std::size_t>(s.mesh.vertex_count()), false);
  for (const auto& edge : s.mesh.edge_vertices[0])
    for (const int v : edge) s.border[static_cast<std::size_t>(v)] = true;
  return s;
}

int inverted(const Sheet& s, const Points2& positions) {
  int count = 0;
  for (int f = 0; f < s.mesh.triangle_count(); ++f) count += s.gradients.of(positions, f).determinant() < kLeast;
  return count;
}

TEST(UnfoldTriangles, LeavesAMeshAloneThatHasNoInvertedTriangle) {
  const Sheet s = sheet();
  Points2 positions = 1.3 * s.mesh.rest;
  const Points2 before = positions;
  EXPECT_EQ(unfold_triangles(s.gradients, s.border, kLeast, positions).inverted_before, 0);
  EXPECT_EQ(positions, before);
}

TEST(UnfoldTriangles, OpensInvertedTrianglesWithoutMovingTheBorderOrWhatIsFarAway) {
  const Sheet s = sheet();
  Points2 positions = s.mesh.rest;
  const Vec2 centre(0.13, 0.2), away(0.33, 0.2);
  int folded = -1;
  for (int v = 0; v < positions.rows(); ++v)
    if ((s.mesh.rest.row(v).transpose() - centre).norm() < 0.02) folded = v;
  ASSERT_GE(folded, 0);
  positions.row(folded) += Vec2(0.07, 0.02).transpose();  // two cells across
  const Points2 before = positions;
  ASSERT_GT(inverted(s, positions), 0);
  const UnfoldResult result = unfold_triangles(s.gradients, s.border, kLeast, positions);
  EXPECT_EQ(result.inverted_after, 0);
  EXPECT_EQ(inverted(s, positions), 0);
  for (int v = 0; v < positions.rows(); ++v) {
    if (s.border[static_cast<std::size_t>(v)] || (s.mesh.rest.row(v).transpose() - away).norm() < 0.04) {
      EXPECT_EQ((positions.row(v) - before.row(v)).norm(), 0.0) << v;
    }
  }
}

TEST(UnfoldTriangles, UntanglesEverythingInsideAnOutlineThatIsBentIntoAHook) {
  const Sheet s = sheet();
  Points2 positions = s.mesh.rest;
  for (int v = 0; v < positions.rows(); ++v) {
    const Vec2 p = s.mesh.rest.row(v);
    const double angle = 4.0 * (p.x() - 0.2) / 0.4, r = 0.1 + p.y();  // 230 degrees of a ring
    positions.row(v) = s.border[static_cast<std::size_t>(v)]
                           ? Vec2(-r * std::cos(angle), r * std::sin(angle)).transpose()
                           : Vec2(0.3 * p.x(), 0.1 * p.y()).transpose();
  }
  ASSERT_GT(inverted(s, positions), 50);
  EXPECT_EQ(unfold_triangles(s.gradients, s.border, kLeast, positions).inverted_after, 0);
}

}  // namespace
}  // namespace toile
