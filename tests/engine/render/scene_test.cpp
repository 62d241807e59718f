// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/scene.h"

#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/render/osmesa_context.h"
#include "engine/render/palette.h"

namespace toile {
namespace {

// A square in the plane z = `depth`, facing +Z, as two triangles.
Surface square(double half, double depth, Rgb colour) {
  Surface surface;
  surface.vertices.resize(4, 3);
  surface.vertices << -half, -half, depth, half, -half, depth, half, half, depth, -half, half, depth;
  surface.triangles.resize(2, 3);
  surface.triangles << 0, 1, 2, 0, 2, 3;
  surface.colours = {colour, colour};
  return surface;
}

Box unit_box() {
  Box box;
  box.low = Vec3::Constant(-1), box.high = Vec3::Constant(1);
  return box;
}

constexpr Rgb kRed{200, 40, 30}, kBlue{30, 60, 190};
constexpr int kPixels = 200;

Image paint_front(const std::vector<Surface>& surfaces) {
  return paint(surfaces, camera_for(View::Front, unit_box(), 2.0 / kPixels), 1, kWhite);
}

int count(const Image& image, Rgb colour) {
  int n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) n += image.at(x, y) == colour;
  return n;
}

TEST(Scene, AFacingTriangleShowsItsColourAndCoversItsArea) {
  const Image image = paint_front({square(0.5, 0, kRed)});
  ASSERT_EQ(image.width, kPixels);
  ASSERT_EQ(image.height, kPixels);
  // Half of each side: a quarter of the pixels, to within the rim.
  EXPECT_NEAR(count(image, kRed), kPixels * kPixels / 4, 2 * kPixels);
  EXPECT_EQ(image.at(kPixels / 2, kPixels / 2), kRed);
  EXPECT_EQ(image.at(3, 3), kWhite);
}

TEST(Scene, TheNearerSurfaceHidesTheFarther) {
  const Image image = paint_front({square(0.5, 0.3, kRed), square(0.9, -0.3, kBlue)});
  EXPECT_EQ(image.at(kPixels / 2, kPixels / 2), kRed);
  EXPECT_EQ(image.at(kPixels / 2, kPixels / 10), kBlue);
}

TEST(Scene, TheWrongSideIsSeenDarker) {
  const Image image = paint({square(0.5, 0, kRed)}, camera_for(View::Back, unit_box(), 2.0 / kPixels), 1, kWhite);
  const Rgb inside = image.at(kPixels / 2, kPixels / 2);
  EXPECT_LT(inside.r, kRed.r);
  EXPECT_GT(inside.r, kRed.r / 3);
}

TEST(Scene, EachViewHasTheWearersLeftWhereItBelongs) {
  Surface left_hand = square(0.1, 0, kRed);
  left_hand.vertices.col(0).array() += 0.8;
  const auto column_of_red = [&](View view) {
    const Image image = paint({left_hand}, camera_for(view, unit_box(), 2.0 / kPixels), 1, kWhite);
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, kPixels / 2) != kWhite) return x;
    return -1;
  };
  EXPECT_GT(column_of_red(View::Front), kPixels / 2);
  EXPECT_GE(column_of_red(View::Back), 0);
  EXPECT_LT(column_of_red(View::Back), kPixels / 2);
}

TEST(Scene, ProjectionAgreesWithThePixels) {
  Surface patch = square(0.05, 0.2, kBlue);
  patch.vertices.col(0).array() += 0.4;
  patch.vertices.col(1).array() -= 0.6;
  const Camera camera = camera_for(View::Front, unit_box(), 2.0 / kPixels);
  const Image image = paint({patch}, camera, 1, kWhite);
  const Vec3 at = camera.project({0.4, -0.6, 0.2});
  EXPECT_EQ(image.at(static_cast<int>(at.x()), static_cast<int>(at.y())), kBlue);
  EXPECT_NEAR(at.x(), 140, 1e-9);
  EXPECT_NEAR(at.y(), 160, 1e-9);
}

TEST(Scene, BrightnessIsOneWhereTheSurfaceFacesTheViewerAndFallsTowardsItsRim) {
  EXPECT_DOUBLE_EQ(brightness(Vec3::UnitZ()), 1.0);
  EXPECT_LT(brightness(-Vec3::UnitY()), 0.6);
  EXPECT_LT(brightness(Vec3::UnitX()), 0.8);
}

TEST(Scene, BrokenInputIsLeftOutInsteadOfDrawn) {
  Surface broken = square(0.5, 0, kRed);
  broken.triangles(0, 1) = 77;
  broken.triangles(1, 2) = -1;
  broken.lines = {{0, 99}, {-3, 1}};
  EXPECT_EQ(count(paint_front({broken}), kWhite), kPixels * kPixels);
  Surface infinite = square(0.5, 0, kRed);
  infinite.vertices(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(count(paint_front({infinite}), kWhite), kPixels * kPixels);
  EXPECT_EQ(count(paint_front({}), kWhite), kPixels * kPixels);
  EXPECT_EQ(count(paint_front({Surface{}}), kWhite), kPixels * kPixels);
}

TEST(Scene, TwoThreadsPaintTheSamePixels) {
  std::vector<Surface> surfaces = {square(0.7, 0, kRed), square(0.5, 0.1, kBlue)};
  surfaces[1].vertices(2, 2) = 0.9;
  const Image alone = paint_front(surfaces);
  std::array<Image, 2> together;
  std::thread first([&] { together[0] = paint_front(surfaces); });
  std::thread second([&] { together[1] = paint_front(surfaces); });
  first.join();
  second.join();
  ASSERT_GT(count(alone, kRed), 100);
  EXPECT_EQ(together[0].rgb, alone.rgb);
  EXPECT_EQ(together[1].rgb, alone.rgb);
}

TEST(Rasterise, RefusesSidesItCannotMake) {
  EXPECT_THROW(rasterise({}, 10000, 10, kWhite), Error);
  EXPECT_THROW(rasterise({}, 0, 10, kWhite), Error);
}

}  // namespace
}  // namespace toile
