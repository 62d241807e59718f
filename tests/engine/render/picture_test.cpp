// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include <gtest/gtest.h>

#include "engine/core/content_hash.h"
#include "engine/render/canvas.h"
#include "engine/render/contact_sheet.h"
#include "engine/render/palette.h"
#include "engine/render/png.h"
#include "engine/render/stroke_font.h"

namespace toile {
namespace {

int count_other_than(const Image& image, Rgb colour, int x0, int x1) {
  int n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = x0; x < x1; ++x) n += image.at(x, y) != colour;
  return n;
}

Surface ball(int rings, Rgb colour) {
  Surface surface;
  const int columns = 2 * rings;
  surface.vertices.resize((rings + 1) * columns, 3);
  for (int r = 0; r <= rings; ++r)
    for (int c = 0; c < columns; ++c) {
      const double polar = 3.14159265358979 * r / rings, around = 3.14159265358979 * c / rings;
      surface.vertices.row(r * columns + c) << std::sin(polar) * std::sin(around), std::cos(polar),
          std::sin(polar) * std::cos(around);
    }
  surface.triangles.resize(2 * rings * columns, 3);
  for (int r = 0; r < rings; ++r)
    for (int c = 0; c < columns; ++c) {
      const int a = r * columns + c, b = r * columns + (c + 1) % columns;
      surface.triangles.row(2 * (r * columns + c)) << a, a + columns, b;
      surface.triangles.row(2 * (r * columns + c) + 1) << b, a + columns, b + columns;
    }
  surface.colours.assign(static_cast<std::size_t>(surface.triangles.rows()), colour);
  return surface;
}

SheetOptions sheet_of_ball() {
  SheetOptions options;
  options.frame.low = Vec3::Constant(-1.1), options.frame.high = Vec3::Constant(1.1);
  options.view_height = options.max_view_width = 120;
  return options;
}

TEST(Palette, StretchIsRedGreenAndBlueAndStaysInsideItsScale) {
  EXPECT_EQ(stretch_colour(5.0, 0.1), stretch_colour(0.1, 0.1));
  EXPECT_EQ(stretch_colour(-5.0, 0.1), stretch_colour(-0.1, 0.1));
  const Rgb plus = stretch_colour(0.1, 0.1), zero = stretch_colour(0, 0.1), minus = stretch_colour(-0.1, 0.1);
  EXPECT_TRUE(plus.r > 2 * plus.g && plus.r > 2 * plus.b);
  EXPECT_TRUE(zero.g > zero.r && zero.g > zero.b);
  EXPECT_TRUE(minus.b > 2 * minus.r && minus.b > 2 * minus.g);
  EXPECT_EQ(stretch_colour(std::numeric_limits<double>::quiet_NaN(), 0.1), (Rgb{128, 128, 128}));
}

TEST(Canvas, AFilledPolygonHasItsArea) {
  Canvas canvas(100, 80, 4, kWhite);
  canvas.fill({{10, 10}, {60, 10}, {60, 50}, {10, 50}}, kInk);
  const Image image = canvas.finish();
  EXPECT_EQ(count_other_than(image, kWhite, 0, 100), 50 * 40);
  EXPECT_EQ(image.at(10, 10), kInk);
  EXPECT_EQ(image.at(9, 10), kWhite);
}

TEST(Canvas, ALineHasItsWidthAndSoftEdges) {
  Canvas canvas(100, 100, 4, kWhite);
  canvas.line({{10, 50}, {90, 53}}, 4.0, kInk);
  const Image image = canvas.finish();
  double darkness = 0;
  int soft = 0;
  for (int y = 0; y < 100; ++y) {
    const Rgb pixel = image.at(50, y);
    darkness += (255.0 - pixel.r) / (255.0 - kInk.r);
    soft += pixel != kWhite && pixel != kInk;
  }
  EXPECT_NEAR(darkness, 4.0, 0.15);
  EXPECT_GE(soft, 1);
}

TEST(Canvas, DashesLeaveGaps) {
  Canvas canvas(200, 20, 2, kWhite);
  canvas.dashed_line({{0, 10}, {100, 10}, {200, 10}}, 2, kInk, 10, 10);
  const Image image = canvas.finish();
  EXPECT_EQ(image.at(5, 10), kInk);
  EXPECT_EQ(image.at(15, 10), kWhite);
  EXPECT_EQ(image.at(105, 10), kInk);
}

TEST(Canvas, DrawingOutsideOrWithoutNumbersDoesNothing) {
  Canvas canvas(20, 20, 2, kWhite);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  canvas.fill({{1e12, 0}, {1e12, 5}, {1e13, 9}}, kInk);
  canvas.fill({{nan, 0}, {5, 5}, {0, 9}}, kInk);
  canvas.line({{nan, 0}, {5, 5}}, 2, kInk);
  canvas.line({}, 2, kInk, true);
  canvas.dashed_line({{0, 0}, {9, 9}}, 2, kInk, 0, 0);
  canvas.text({50, 50}, 10, "away", kInk);
  EXPECT_EQ(count_other_than(canvas.finish(), kWhite, 0, 20), 0);
}

TEST(StrokeFont, EveryPrintableCharacterHasStrokesInsideItsWidth) {
  for (char c = '!'; c <= '~'; ++c) {
    const std::string text(1, c);
    const auto strokes = text_strokes(text, 6.0);
    ASSERT_FALSE(strokes.empty()) << c;
    for (const auto& stroke : strokes) {
      ASSERT_GE(stroke.size(), 2u) << c;
      for (const Vec2& p : stroke) {
        EXPECT_GE(p.x(), 0) << c;
        EXPECT_LE(p.x(), text_width(text, 6.0)) << c;
        EXPECT_GE(p.y(), -2) << c;
        EXPECT_LE(p.y(), 7) << c;
      }
    }
  }
  EXPECT_EQ(text_strokes("\xC3\xA4", 6.0).size(), text_strokes("?", 6.0).size());
}

TEST(ContactSheet, FourViewsStandSideBySideAndTheSameBytesComeTwice) {
  const Image image = contact_sheet({ball(12, panel_colour(0))}, sheet_of_ball());
  EXPECT_GT(image.width, 4 * 120);
  const int quarter = image.width / 4;
  for (int i = 0; i < 4; ++i) EXPECT_GT(count_other_than(image, kWhite, i * quarter, (i + 1) * quarter), 5000) << i;
  const Image again = contact_sheet({ball(12, panel_colour(0))}, sheet_of_ball());
  EXPECT_EQ(sha256_hex(write_png(image)), sha256_hex(write_png(again)));
}

TEST(ContactSheet, SilhouettesAreAntialiased) {
  const Image image = contact_sheet({ball(24, Rgb{0, 0, 0})}, sheet_of_ball());
  int between = 0;
  for (int y = 12; y < 132; ++y)
    for (int x = 12; x < 132; ++x) {
      const Rgb pixel = image.at(x, y);
      between += pixel.r > 20 && pixel.r < 235;
    }
  EXPECT_GT(between, 100);
}

TEST(ContactSheet, TheLegendAddsItsColoursBesideTheViews) {
  SheetOptions options = sheet_of_ball();
  const Image without = contact_sheet({ball(12, kSkin)}, options);
  options.stretch_scale = 0.1;
  const Image with = contact_sheet({ball(12, kSkin)}, options);
  ASSERT_GT(with.width, without.width + 60);
  bool red = false, green = false, blue = false;
  for (int y = 0; y < with.height; ++y)
    for (int x = without.width; x < with.width; ++x) {
      const Rgb pixel = with.at(x, y);
      red |= pixel.r > 150 && pixel.g < 80, blue |= pixel.b > 150 && pixel.r < 80;
      green |= pixel.g > 150 && pixel.r < 100 && pixel.b < 100;
    }
  EXPECT_TRUE(red && green && blue);
}

TEST(ContactSheet, AMarkIsDrawnInTheViewThatFacesIt) {
  SheetOptions options = sheet_of_ball();
  const Image without = contact_sheet({ball(12, kSkin)}, options);
  options.marks = {{Vec3(0, 0, -1), -Vec3::UnitZ(), "+9.0 %"}};
  const Image with = contact_sheet({ball(12, kSkin)}, options);
  ASSERT_EQ(with.width, without.width);
  const int quarter = with.width / 4;
  std::array<int, 4> changed{};
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x)
      changed[static_cast<std::size_t>(std::min(3, x / quarter))] += with.at(x, y) != without.at(x, y);
  EXPECT_EQ(changed[0], 0);
  EXPECT_GT(changed[1], 100);
  EXPECT_EQ(changed[2] + changed[3], 0);
}

TEST(ContactSheet, NothingToSeeIsStillAPicture) {
  const Image blank = contact_sheet({}, SheetOptions{});
  EXPECT_GT(blank.width, 16);
  SheetOptions no_views;
  no_views.views.clear();
  no_views.marks = {{}};
  no_views.title = "nothing";
  EXPECT_GT(count_other_than(contact_sheet({}, no_views), kWhite, 0, 100), 20);
}

TEST(Png, StartsWithItsSignatureAndStatesItsSize) {
  const Bytes png = write_png(Image(300, 7, kSkin));
  const Bytes signature = {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};
  ASSERT_GT(png.size(), 40u);
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), png.begin()));
  EXPECT_EQ(png[18] * 256 + png[19], 300);
  EXPECT_EQ(png[23], 7);
}

}  // namespace
}  // namespace toile
