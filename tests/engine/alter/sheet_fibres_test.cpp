// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sheet_fibres.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kLimit = 5.0;  // degrees, that fibres may be off a right angle

double angle_between(const Mat2& shape) {
  const Vec2 u = shape.col(0), v = shape.col(1);
  return std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)) / kRadianPerDegree;
}

TEST(SheetFibres, AreProjectedToTheirLengthsWithinTheShearLimit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1.5, 1.5), length(0.5, 1.2);
  int sheared = 0;
  for (int i = 0; i < 500; ++i) {
    const Mat2 gradient = (Mat2() << entry(random), entry(random), entry(random), entry(random)).finished();
    const Vec2 wanted(length(random), length(random));
    const Mat2 shape = fibre_projection(gradient, wanted);
    ASSERT_NEAR(shape.col(0).norm(), wanted[0], 1e-12);
    ASSERT_NEAR(shape.col(1).norm(), wanted[1], 1e-12);
    ASSERT_NEAR(angle_between(shape), 90.0, kLimit + 1e-9);
    sheared += std::abs(angle_between(shape) - 90.0) > kLimit - 1e-9;
    // No turn of it is nearer.
    for (const double turn : {-0.01, 0.01})
      ASSERT_LE((gradient - shape).norm(), (gradient - Eigen::Rotation2Dd(turn) * shape).norm() + 1e-12);
  }
  EXPECT_GT(sheared, 100);
  EXPECT_LT(sheared, 500);
}

TEST(SheetFibres, KeepTheirDirectionsWithinTheShearLimit) {
  const Mat2 gradient = Eigen::Rotation2Dd(0.4).toRotationMatrix() * (Mat2() << 1.3, 0.05, 0.0, 0.9).finished();
  const Mat2 shape = fibre_projection(gradient, {1.0, 1.0});
  EXPECT_LT((shape.col(0) - gradient.col(0).normalized()).norm(), 1e-15);
  EXPECT_LT((shape.col(1) - gradient.col(1).normalized()).norm(), 1e-15);
}

TEST(SheetFibres, OfACollapsedFaceStandAtARightAngle) {
  for (const Mat2& gradient :
       {Mat2(Mat2::Zero()), (Mat2() << 1, 0, 0, 0).finished(), (Mat2() << 0, 0, 0, 1).finished()})
    EXPECT_NEAR(angle_between(fibre_projection(gradient, {0.8, 1.0})), 90.0, 1e-9);
}

}  // namespace
}  // namespace toile
