// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/membrane.h"

#include "tests/engine/sim/finite_difference.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

Fabric anisotropic() {
  Fabric fabric;
  fabric.weft_stiffness = 700;
  fabric.warp_stiffness = 1300;
  fabric.shear_stiffness = 90;
  return fabric;
}

struct MembraneSheet {
  Pattern pattern = test::sheet_pattern(0.4, 0.6, 1.0);
  PatternMesh mesh = test::structured_mesh(pattern, 3, 5);
  Points3 flat = test::placed_nodes(pattern, mesh);
  Cloth cloth;
  MembraneSheet() {
    pattern.fabric = anisotropic();
    cloth = make_cloth(pattern, mesh);
  }
  test::EnergyFunction energy() const {
    return [this](const Points3& x, Points3& g) {
      g.setZero();
      return membrane_energy_gradient(cloth, x, g);
    };
  }
};

TEST(Membrane, GradientIsTheDerivativeOfTheEnergyWhenCrumpled) {
  const MembraneSheet s;
  test::expect_gradient(s.energy(), s.flat + test::random_points(s.mesh.node_count, 0.05, 1));
}

TEST(Membrane, GradientIsTheDerivativeOfTheEnergyUnderCompressionAndInsideOut) {
  const MembraneSheet s;
  Points3 small = 0.3 * s.flat + test::random_points(s.mesh.node_count, 0.01, 2);
  test::expect_gradient(s.energy(), small);
  small.col(0) *= -1;
  test::expect_gradient(s.energy(), small);
}

TEST(Membrane, GradientStaysFiniteWhereTrianglesCollapse) {
  const MembraneSheet s;
  Points3 line = s.flat;
  line.col(0).setZero();
  Points3 gradient = Points3::Zero(s.mesh.node_count, 3);
  EXPECT_TRUE(std::isfinite(membrane_energy_gradient(s.cloth, line, gradient)));
  EXPECT_TRUE(gradient.allFinite());
  gradient.setZero();
  const Points3 point = Points3::Zero(s.mesh.node_count, 3);
  EXPECT_TRUE(std::isfinite(membrane_energy_gradient(s.cloth, point, gradient)));
  EXPECT_TRUE(gradient.allFinite());
}

TEST(Membrane, RigidMotionHasNeitherEnergyNorForce) {
  const MembraneSheet s;
  const Mat3 turn = (Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  const Points3 moved = (s.flat * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -2, 1);
  Points3 gradient = Points3::Zero(s.mesh.node_count, 3);
  EXPECT_NEAR(membrane_energy_gradient(s.cloth, moved, gradient), 0, 1e-7);
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Membrane, UniaxialStretchCostsTheStiffnessOfThatDirection) {
  const MembraneSheet s;
  Points3 wide = s.flat;
  wide.col(0) *= 1.1;
  Points3 gradient = Points3::Zero(s.mesh.node_count, 3);
  const double area = 0.4 * 0.6;
  EXPECT_NEAR(membrane_energy_gradient(s.cloth, wide, gradient), 0.5 * area * (700 + 90) * 0.01, 1e-6);
  Points3 tall = s.flat;
  tall.col(1) *= 1.1;
  EXPECT_NEAR(membrane_energy_gradient(s.cloth, tall, gradient), 0.5 * area * (1300 + 90) * 0.01, 1e-6);
}

TEST(Membrane, GrainlineTurnsTheStiffDirection) {
  MembraneSheet s;
  s.pattern.panels[0].grainline = std::array<Vec2, 2>{Vec2(0, 0), Vec2(1, 0)};
  const Cloth turned = make_cloth(s.pattern, s.mesh);
  Points3 wide = s.flat;
  wide.col(0) *= 1.1;
  Points3 gradient = Points3::Zero(s.mesh.node_count, 3);
  EXPECT_NEAR(membrane_energy_gradient(turned, wide, gradient), 0.5 * 0.24 * (1300 + 90) * 0.01, 1e-6);
}

TEST(Membrane, PaddingLanesCarryNothing) {
  const Pattern pattern = test::sheet_pattern(0.1, 0.1, 1.0);
  const PatternMesh mesh = test::structured_mesh(pattern, 1, 1);  // two triangles in a block of four
  const Cloth cloth = make_cloth(pattern, mesh);
  ASSERT_EQ(cloth.blocks.size(), 1u);
  Points3 gradient = Points3::Zero(4, 3);
  const Points3 doubled = 2 * test::placed_nodes(pattern, mesh);
  const double exact = 0.5 * 0.01 * (1000 + 1000 + 2 * 60);
  EXPECT_NEAR(membrane_energy_gradient(cloth, doubled, gradient), exact, 1e-6);
}

TEST(Membrane, BoundIsNotBelowTheSecondDerivativeInTension) {
  const MembraneSheet s;
  const SparseMatrix bound = membrane_bound(s.cloth);
  const Points3 tense = 1.05 * s.flat;
  for (unsigned k = 0; k < 6; ++k) {
    const Points3 d = test::random_points(s.mesh.node_count, 1.0, 40 + k);
    Points3 plus = Points3::Zero(s.mesh.node_count, 3), minus = plus;
    membrane_energy_gradient(s.cloth, tense + 1e-6 * d, plus);
    membrane_energy_gradient(s.cloth, tense - 1e-6 * d, minus);
    const double curvature = (plus - minus).cwiseProduct(d).sum() / 2e-6;
    double upper = 0;
    for (int c = 0; c < 3; ++c) upper += d.col(c).dot(bound.selfadjointView<Eigen::Lower>() * d.col(c));
    EXPECT_GT(curvature, 0);
    EXPECT_LE(curvature, upper * (1 + 1e-6));
  }
}

}  // namespace
}  // namespace toile
