// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives against central differences of the gradients, through every branch of every energy.
#include "engine/sim/drape_energy.h"
#include "engine/sim/energy_hessian.h"
#include "engine/sim/membrane.h"
#include "tests/engine/sim/finite_difference.h"
#include "tests/engine/sim/tube_scene.h"
#include "tests/support/solids.h"

namespace toile {
namespace {

using test::kRadius;

using Gradient = std::function<Points3(const Points3&)>;

// Along eight random directions; requires curvature there, so that the check cannot pass by accident.
void expect_hessian(const Gradient& gradient, const BlockHessian& hessian, const Points3& nodes, double step,
                    double tolerance) {
  for (unsigned k = 0; k < 8; ++k) {
    const Points3 direction = test::random_points(static_cast<int>(nodes.rows()), 1.0, 200 + k);
    const Points3 difference = (gradient(nodes + step * direction) - gradient(nodes - step * direction)) / (2 * step);
    ASSERT_GT(difference.norm(), 1e-3);
    EXPECT_LT((hessian.times(direction) - difference).norm(), tolerance * difference.norm()) << k;
  }
}

Eigen::MatrixXd dense(const BlockHessian& hessian) {
  const Eigen::MatrixXd lower = hessian.lower_triangle();
  return lower.selfadjointView<Eigen::Lower>();
}

double least_eigenvalue(const BlockHessian& hessian) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(hessian)).eigenvalues().minCoeff();
}

struct HessianSheet {
  Pattern pattern = test::sheet_pattern(0.4, 0.6, 1.0);
  PatternMesh mesh = test::structured_mesh(pattern, 3, 5);
  Points3 flat = test::placed_nodes(pattern, mesh);
  Cloth cloth;
  HessianSheet() {
    pattern.fabric.weft_stiffness = 700;
    pattern.fabric.warp_stiffness = 1300;
    pattern.fabric.shear_stiffness = 90;
    cloth = make_cloth(pattern, mesh);
  }
  Gradient membrane() const {
    return [this](const Points3& x) {
      Points3 g = Points3::Zero(x.rows(), 3);
      membrane_energy_gradient(cloth, x, g);
      return g;
    };
  }
  BlockHessian membrane_hessian(const Points3& x, Curvature curvature) const {
    BlockHessian hessian(cloth);
    add_membrane_hessian(cloth, x, curvature, hessian);
    return hessian;
  }
  // In tension, compressed, inside out, sheared, crumpled.
  std::vector<Points3> shapes() const {
    const int n = mesh.node_count;
    std::vector<Points3> shapes = {1.1 * flat + test::random_points(n, 0.002, 1),
                                   0.4 * flat + test::random_points(n, 0.01, 2), flat + test::random_points(n, 0.05, 3),
                                   flat, flat + test::random_points(n, 0.002, 4)};
    shapes[3].col(0) *= -0.3;
    shapes[3] += test::random_points(n, 0.01, 5);
    shapes[4].col(0) += 0.5 * shapes[4].col(1);
    return shapes;
  }
};

TEST(Hessian, OfTheMembraneIsTheDerivativeOfItsGradientInEveryShape) {
  const HessianSheet s;
  for (const Points3& x : s.shapes())
    expect_hessian(s.membrane(), s.membrane_hessian(x, Curvature::Exact), x, 1e-7, 1e-5);
}

TEST(Hessian, OfTheMembraneIsExactAtRestAndSeesRigidMotion) {
  const HessianSheet s;
  const BlockHessian hessian = s.membrane_hessian(s.flat, Curvature::Exact);
  expect_hessian(s.membrane(), hessian, s.flat, 1e-7, 1e-4);
  const Points3 shift = Points3::Ones(s.mesh.node_count, 3);
  EXPECT_LT(hessian.times(shift).norm(), 1e-9);
}

TEST(Hessian, OfTheMembraneStaysFiniteWhereTrianglesCollapse) {
  const HessianSheet s;
  Points3 line = s.flat;
  line.col(0).setZero();
  for (const Points3& x : {line, Points3(Points3::Zero(s.mesh.node_count, 3))})
    for (const Curvature curvature : {Curvature::Exact, Curvature::Projected})
      EXPECT_TRUE(dense(s.membrane_hessian(x, curvature)).allFinite());
}

TEST(Hessian, ProjectedHasNoNegativeCurvatureWhereTheExactOneHas) {
  const HessianSheet s;
  int negative = 0;
  for (const Points3& x : s.shapes()) {
    negative += least_eigenvalue(s.membrane_hessian(x, Curvature::Exact)) < -1.0;
    EXPECT_GT(least_eigenvalue(s.membrane_hessian(x, Curvature::Projected)), -1e-8);
  }
  EXPECT_GE(negative, 3);
}

TEST(Hessian, ProjectedIsExactInTension) {
  const HessianSheet s;
  const Points3 x = 1.1 * s.flat;
  const Eigen::MatrixXd exact = dense(s.membrane_hessian(x, Curvature::Exact));
  EXPECT_LT((dense(s.membrane_hessian(x, Curvature::Projected)) - exact).norm(), 1e-9 * exact.norm());
}

void expect_contact_hessian(const test::TubeScene& s, Contact& contact, const Points3& x, double tolerance) {
  BlockHessian hessian(s.cloth);
  contact.add_hessian(x, Curvature::Exact, hessian);
  const Gradient gradient = [&](const Points3& p) {
    Points3 g = Points3::Zero(p.rows(), 3);
    contact.energy_gradient(p, g);
    return g;
  };
  expect_hessian(gradient, hessian, x, 1e-7, tolerance);
  BlockHessian projected(s.cloth);
  contact.add_hessian(x, Curvature::Projected, projected);
  EXPECT_GT(least_eigenvalue(projected), -1e-6);
}

TEST(Hessian, OfContactIsTheDerivativeWhenTouchingAndWhenDeep) {
  test::TubeScene s;
  for (double radius : {kRadius + 0.001, kRadius - 0.02}) {
    Contact contact(s.cloth, s.field, {});
    expect_contact_hessian(s, contact, s.at(radius) + test::random_points(s.mesh.node_count, 3e-4, 5), 1e-5);
  }
}

TEST(Hessian, OfFrictionIsTheDerivativeStickingAndSliding) {
  test::TubeScene s;
  const Points3 touching = s.at(kRadius + 0.002);
  for (double slide : {0.0, 0.0004, 0.004}) {
    Contact contact(s.cloth, s.field, {});
    contact.freeze_friction(touching);
    Points3 moved = touching + test::random_points(s.mesh.node_count, 1e-4, 6);
    moved.col(1).array() += slide;
    expect_contact_hessian(s, contact, moved, 1e-3);
  }
}

TEST(Hessian, OfTheFrictionProfileAtItsAnchorIsASpringInThePlane) {
  const Mat3 h = friction_hessian(2.0, 0.001, Vec3::Zero(), Vec3::UnitY());
  EXPECT_LT((h - 4000 * Vec3(1, 0, 1).asDiagonal().toDenseMatrix()).norm(), 1e-9);
}

TEST(Hessian, OfTheWholeEnergyHasHoldsPinsBendingAndContact) {
  test::TubeScene s;
  s.pattern.fabric.bending_stiffness = 1e-3;
  s.cloth = make_cloth(s.pattern, s.mesh);
  Contact contact(s.cloth, s.field, {});
  DrapeEnergy energy(s.cloth, &contact, 9.81);
  const Points3 x = s.at(kRadius + 0.002);
  energy.holds = {{3, x(3, 1) + 0.01, 500.0}, {4, x(4, 1) - 0.01, 500.0}};
  energy.pins = {{7, Vec3(0.1, 0.2, 0.3), 300.0}};
  contact.freeze_friction(x);
  const Points3 moved = x + test::random_points(s.mesh.node_count, 2e-4, 11);
  BlockHessian hessian(s.cloth);
  energy.evaluate_hessian(moved, Curvature::Exact, hessian);
  const Gradient gradient = [&](const Points3& p) {
    Points3 g(p.rows(), 3);
    energy.evaluate(p, g);
    return g;
  };
  expect_hessian(gradient, hessian, moved, 1e-7, 1e-3);
}

TEST(Hessian, OfABodysFieldIsTheDerivativeOfItsGradient) {
  const Body body = test::tube_body(
      "tube", [](double y) { return 0.12 + 0.03 * std::sin(6 * y); }, 0.6);
  SurfaceField surface(body.surface.vertices, body.surface.triangles);
  BellyField belly(0.13, 0.04, 0.3, 0.08);
  CylinderField cylinder(kRadius);
  // The points lie inside cells of the lattice: on their borders the second derivative jumps.
  for (SignedField* field : std::initializer_list<SignedField*>{&surface, &belly, &cylinder})
    for (const Vec3& p : {Vec3(0.1103, 0.3108, 0.0612), Vec3(-0.0317, 0.2231, 0.1302), Vec3(0.0094, 0.3512, -0.1513)}) {
      Mat3 difference;
      for (int d = 0; d < 3; ++d) {
        Vec3 ahead, behind;
        field->evaluate(p + 1e-6 * Vec3::Unit(d), 1.0, ahead);
        field->evaluate(p - 1e-6 * Vec3::Unit(d), 1.0, behind);
        difference.col(d) = (ahead - behind) / 2e-6;
      }
      ASSERT_GT(difference.norm(), 1.0);
      EXPECT_LT((field->hessian(p) - difference).norm(), 1e-5 * difference.norm());
    }
}

TEST(Hessian, TakesBlocksBetweenNodesThatShareNoTriangle) {
  HessianSheet s;
  BlockHessian hessian(s.cloth);
  Mat3 block;
  block << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  hessian.add(0, s.mesh.node_count - 1, block);
  const Eigen::MatrixXd all = dense(hessian);
  EXPECT_EQ((all.block<3, 3>(0, all.cols() - 3)), block);
  EXPECT_EQ((all.block<3, 3>(all.rows() - 3, 0)), block.transpose());
  Points3 x = Points3::Zero(s.mesh.node_count, 3);
  x.row(s.mesh.node_count - 1) << 1, 0, 2;
  EXPECT_EQ(Vec3(hessian.times(x).row(0)), block * Vec3(1, 0, 2));
}

}  // namespace
}  // namespace toile
