// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/build_fitting_map.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/stages/compare_fits.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using test::grid_garment;
using test::GridGarment;

constexpr double kRounding = 1e-12;

Mat32 gradient_of(double weft, double warp, double shear) {
  Mat32 gradient;
  gradient.col(0) = weft * Vec3(1, 0, 0);
  gradient.col(1) = warp * Vec3(std::sin(shear), std::cos(shear), 0);
  const Mat3 turn = (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  return turn * gradient;
}

// Bends the flat panel round a cylinder of radius `r`, stretched by (weft, warp).
Drape round_cylinder(const GridGarment& garment, double r, double weft, double warp) {
  Drape drape;
  drape.nodes.resize(garment.mesh.node_count, 3);
  for (int v = 0; v < garment.mesh.vertex_count(); ++v) {
    const double angle = weft * garment.mesh.rest(v, 0) / r;
    drape.nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
        Vec3(r * std::sin(angle), warp * garment.mesh.rest(v, 1), r * std::cos(angle)).transpose();
  }
  return drape;
}

TEST(FittingTensor, IsTheStretchAndShearOfTheGradientWhateverItsRotation) {
  Mat2 tensor;
  ASSERT_TRUE(fitting_tensor(gradient_of(1.1, 0.9, 0.2), tensor));
  Mat2 wanted;
  wanted << 1.1, 0.9 * std::sin(0.2), 0.0, 0.9 * std::cos(0.2);
  EXPECT_LT((tensor - wanted).norm(), kRounding);
}

TEST(FittingTensor, FallsBackToThePolarFrameWhereTheTriangleIsALine) {
  Mat32 gradient = Mat32::Zero();
  gradient.col(0) = Vec3(2, 0, 0);
  Mat2 tensor;
  EXPECT_FALSE(fitting_tensor(gradient, tensor));
  EXPECT_NEAR(tensor(0, 0), 2.0, kRounding);
  EXPECT_TRUE(tensor.allFinite());
}

TEST(BuildFittingMap, MeasuresStretchRoundACylinder) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 80, 30, 0.2}});
  const FittingMap map = build_fitting_map(garment.mesh, round_cylinder(garment, 0.14, 1.05, 0.97));
  ASSERT_EQ(map.triangle_count(), garment.mesh.triangle_count());
  EXPECT_NEAR(map.rest_area.sum(), 0.24, kRounding);
  // A chord is shorter than its arc by (angle^2)/24, about 6e-5 here.
  EXPECT_NEAR(map.stretch_weft.mean(), 0.05, 1e-3);
  EXPECT_NEAR(map.stretch_warp.mean(), -0.03, 1e-3);
  EXPECT_LT(map.shear.cwiseAbs().mean(), 1e-3);
}

TEST(BuildFittingMap, AgainstAnotherRestShapeMeasuresTheDifferenceOfTheTwo) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 8, 12, 0.2}});
  const Drape drape = round_cylinder(garment, 10.0, 1.2, 1.0);
  const Points2 wider = garment.mapped([](int, const Vec2& p) { return Vec2(1.2 * p.x(), p.y()); });
  EXPECT_NEAR(build_fitting_map(garment.mesh, drape).stretch_weft.mean(), 0.2, 1e-4);
  EXPECT_NEAR(build_fitting_map(garment.mesh, wider, drape).stretch_weft.mean(), 0.0, 1e-4);
}

// Stretch that grows along the weft: that of a triangle is off to one side or the other by how it stands.
TEST(BuildFittingMap, StretchThatVariesIsRecoveredFromNeighbours) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 16, 24, 0.3}, {"back", 0.4, 0.6, 16, 24, 0.0}});
  Drape drape;
  drape.nodes.resize(garment.mesh.node_count, 3);
  for (int v = 0; v < garment.mesh.vertex_count(); ++v) {
    const double s = garment.mesh.rest(v, 0);
    drape.nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) << s + 0.5 * s * s,
        garment.mesh.rest(v, 1), 0;
  }
  const FittingMap map = build_fitting_map(garment.mesh, drape);
  double own = 0, recovered = 0;
  for (int f = 0; f < map.triangle_count(); ++f) {
    const double s =
        (garment.mesh.rest(garment.mesh.triangles(f, 0), 0) + garment.mesh.rest(garment.mesh.triangles(f, 1), 0) +
         garment.mesh.rest(garment.mesh.triangles(f, 2), 0)) /
        3;
    own += map.rest_area[f] * std::pow(map.tensor[static_cast<std::size_t>(f)](0, 0) - 1 - s, 2);
    recovered += map.rest_area[f] * std::pow(map.stretch_weft[f] - s, 2);
  }
  EXPECT_GT(std::sqrt(own / map.rest_area.sum()), 0.003);
  EXPECT_LT(std::sqrt(recovered), 0.4 * std::sqrt(own));
}

TEST(BuildFittingMap, EvenStretchIsRecoveredExactly) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 8, 12, 0.2}});
  Drape drape;
  drape.nodes.resize(garment.mesh.node_count, 3);
  for (int v = 0; v < garment.mesh.vertex_count(); ++v)
    drape.nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) << 1.07 * garment.mesh.rest(v, 0),
        0.96 * garment.mesh.rest(v, 1), 0;
  const FittingMap map = build_fitting_map(garment.mesh, drape);
  EXPECT_LT((map.stretch_weft.array() - 0.07).abs().maxCoeff(), kRounding);
  EXPECT_LT((map.stretch_warp.array() + 0.04).abs().maxCoeff(), kRounding);
}

TEST(BuildFittingMap, RefusesAnInvertedFlatTriangle) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 4, 6, 0.0}});
  const Points2 mirrored = garment.mapped([](int, const Vec2& p) { return Vec2(-p.x(), p.y()); });
  EXPECT_THROW(build_fitting_map(garment.mesh, mirrored, round_cylinder(garment, 1, 1, 1)), Error);
}

TEST(CompareFits, IsZeroForEqualFitsAndTheDifferenceOtherwise) {
  const GridGarment garment = grid_garment({{"front", 0.4, 0.6, 8, 12, 0.2}, {"back", 0.4, 0.6, 8, 12, 0.0}});
  const FittingMap plain = build_fitting_map(garment.mesh, round_cylinder(garment, 50.0, 1.0, 1.0));
  const FittingMap tight = build_fitting_map(garment.mesh, round_cylinder(garment, 50.0, 1.04, 0.98));
  EXPECT_EQ(compare_fits(garment.mesh, plain, plain).whole.rms_stretch, 0.0);
  const FitComparison compared = compare_fits(garment.mesh, plain, tight);
  EXPECT_NEAR(compared.whole.rms_weft, 0.04, 1e-5);
  EXPECT_NEAR(compared.whole.rms_warp, 0.02, 1e-5);
  EXPECT_NEAR(compared.whole.rms_stretch, std::sqrt((0.04 * 0.04 + 0.02 * 0.02) / 2), 1e-5);
  EXPECT_NEAR(compared.whole.mean_weft, 0.04, 1e-5);
  EXPECT_NEAR(compared.whole.share_beyond, 1.0, kRounding);
  EXPECT_NEAR(compare_fits(garment.mesh, plain, tight, {0.05}).whole.share_beyond, 0.0, kRounding);
  ASSERT_EQ(compared.panels.size(), 2u);
  EXPECT_NEAR(compared.panels[1].rms_weft, 0.04, 1e-5);
}

TEST(ComparePositions, MeasuresNodeByNode) {
  Points3 wanted = Points3::Zero(100, 3), reached = wanted;
  reached(7, 1) = 0.02;
  const PositionDifference difference = compare_positions(wanted, reached);
  EXPECT_NEAR(difference.largest, 0.02, kRounding);
  EXPECT_NEAR(difference.rms, 0.002, kRounding);
  EXPECT_EQ(difference.p95, 0.0);
  EXPECT_EQ(difference.worst_node, 7);
}

}  // namespace
}  // namespace toile
