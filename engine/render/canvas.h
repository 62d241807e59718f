// SPDX-License-Identifier: GPL-3.0-or-later
// Flat drawing into a picture: polygons, lines and text, antialiased by supersampling. Coordinates are final pixels,
// x to the right, y down, (0, 0) the upper left corner; exact arithmetic on the same input gives the same pixels.
#pragma once

#include <string_view>

#include "engine/render/image.h"

namespace toile {

enum class Anchor { Left, Middle, Right };

class Canvas {
 public:
  // `supersample` 1..4: that many samples a pixel along each axis.
  Canvas(int width, int height, int supersample, Rgb background);

  int width() const { return width_; }
  int height() const { return height_; }
  int supersample() const { return factor_; }

  // Even-odd fill; fewer than three points fill nothing.
  void fill(const std::vector<Vec2>& polygon, Rgb colour);
  // Round joints and ends; two equal points make a dot.
  void line(const std::vector<Vec2>& points, double width, Rgb colour, bool closed = false);
  void dashed_line(const std::vector<Vec2>& points, double width, Rgb colour, double dash, double gap);
  void circle(const Vec2& centre, double radius, double width, Rgb colour);
  // `height` is that of capitals; `at` lies on the baseline; `angle` of the baseline, rad, counter-clockwise as seen.
  void text(const Vec2& at, double height, std::string_view text, Rgb colour, Anchor anchor = Anchor::Left,
            double angle = 0.0);
  // `part` is already supersampled by the same factor; its upper left corner goes to pixel (x, y).
  void paste_supersampled(const Image& part, int x, int y);

  // The antialiased picture.
  Image finish() const { return downsample(samples_, factor_); }

 private:
  void fill_samples(const std::vector<Vec2>& polygon, Rgb colour);
  void fill_disc(const Vec2& centre, double radius, Rgb colour);

  int width_, height_, factor_;
  Image samples_;
};

}  // namespace toile
