// SPDX-License-Identifier: GPL-3.0-or-later
// A picture in memory: 8-bit sRGB values, rows from the top.
#pragma once

#include <compare>
#include <cstddef>

#include "engine/core/types.h"

namespace toile {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  auto operator<=>(const Rgb&) const = default;
};

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height, row 0 on top

  Image() = default;
  Image(int width_, int height_, Rgb fill);  // both sides 1..32768, else throws Error{LimitExceeded}

  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  Rgb at(int x, int y) const {
    const std::size_t i = offset(x, y);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
  void set(int x, int y, Rgb colour) {
    const std::size_t i = offset(x, y);
    rgb[i] = colour.r, rgb[i + 1] = colour.g, rgb[i + 2] = colour.b;
  }
};

// Copies `part` into `image` with its upper left pixel at (x, y); what falls outside is left out.
void paste(Image& image, const Image& part, int x, int y);

// Mean over factor x factor blocks, rounded: turns a supersampled picture into an antialiased one.
Image downsample(const Image& image, int factor);

}  // namespace toile
