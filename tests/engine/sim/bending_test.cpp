// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/bending.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/sim/cloth.h"
#include "engine/stages/mesh_panels.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

double bending_energy(const SparseMatrix& q, const Points3& x) {
  return 0.5 * (x.transpose() * (q * x)).trace();
}

TEST(Bending, FlatClothMovedAnywhereHasNone) {
  const Pattern pattern = test::sheet_pattern(0.4, 0.6, 1.0);
  const PatternMesh mesh = test::structured_mesh(pattern, 6, 9);
  const SparseMatrix q = bending_matrix(pattern, mesh);
  ASSERT_GT(q.norm(), 0);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 1, 0).normalized()).toRotationMatrix();
  const Points3 moved = (test::placed_nodes(pattern, mesh) * turn).rowwise() + Eigen::RowVector3d(1, 2, 3);
  EXPECT_NEAR(bending_energy(q, moved), 0, 1e-12);
}

// A closed cylinder of radius R: B/2 A / R^2, whatever the mesh.
TEST(Bending, EnergyOfACylinderDoesNotDependOnTheMesh) {
  const double radius = 0.1, height = 0.5, girth = 2 * std::numbers::pi * radius;
  const Pattern pattern = test::tube_skirt_pattern(girth, height, 0, 0.2);
  for (const auto& [columns, rows] : {std::pair(12, 20), std::pair(24, 20), std::pair(48, 12), std::pair(30, 120)}) {
    const PatternMesh mesh = test::structured_mesh(pattern, columns, rows);
    const Points3 x = test::wrapped_tube(
                          pattern, mesh, [&](double) { return radius; }, 0)
                          .nodes;
    const double exact = 0.5 * pattern.fabric.bending_stiffness * girth * height / (radius * radius);
    EXPECT_NEAR(bending_energy(bending_matrix(pattern, mesh), x) / exact, 1, 0.02) << columns << " x " << rows;
  }
}

// A twist z = c x y and a saddle z = c (x^2 - y^2) / 2 have k1 = -k2 = c: c^2 B A, although their curvatures cancel.
TEST(Bending, SaddlesAndTwistsCostAsMuchAsTheirCurvaturesSay) {
  const Pattern pattern = test::sheet_pattern(0.4, 0.6, 0.0);
  const PatternMesh mesh = mesh_panels(pattern, {3000, {}});
  const SparseMatrix q = bending_matrix(pattern, mesh);
  const double exact = pattern.fabric.bending_stiffness * 0.4 * 0.6 * 0.25;
  for (const bool twist : {true, false}) {
    Points3 x = test::placed_nodes(pattern, mesh);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      const double u = x(i, 0), v = x(i, 1);
      x(i, 2) = 0.5 * (twist ? u * v : 0.5 * (u * u - v * v));
    }
    EXPECT_NEAR(bending_energy(q, x) / exact, 1, 0.1) << twist;
  }
}

// A tube pressed flat is folded along its two seams and nowhere else.
TEST(Bending, SeamsTurnedOverFoldFreely) {
  Pattern pattern = test::tube_skirt_pattern(0.6, 0.3, 0, 0);
  const PatternMesh mesh = test::structured_mesh(pattern, 4, 4);
  const Points3 folded = test::placed_nodes(pattern, mesh);
  EXPECT_GT(bending_energy(bending_matrix(pattern, mesh), folded), 1e-5);
  for (Seam& seam : pattern.seams) seam.right_wrong = true;  // the mesh stays welded as it is
  const SparseMatrix q = bending_matrix(pattern, mesh);
  ASSERT_GT(q.norm(), 0);
  EXPECT_NEAR(bending_energy(q, folded), 0, 1e-12);
}

}  // namespace
}  // namespace toile
