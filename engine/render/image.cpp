// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/image.h"

#include <algorithm>
#include <string>

#include "engine/core/error.h"

namespace toile {

Image::Image(int width_, int height_, Rgb fill) : width(width_), height(height_) {
  constexpr int kLongestSide = 32768;
  if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide)
    throw Error(ErrorCode::LimitExceeded, "picture",
                "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels cannot be made; ask for sides of 1 to " + std::to_string(kLongestSide));
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rgb.size(); i += 3) rgb[i] = fill.r, rgb[i + 1] = fill.g, rgb[i + 2] = fill.b;
}

void paste(Image& image, const Image& part, int x, int y) {
  const int left = std::max(0, -x), right = std::min(part.width, image.width - x);
  if (left >= right) return;
  for (int row = std::max(0, -y); row < std::min(part.height, image.height - y); ++row) {
    const auto from = part.rgb.begin() + static_cast<std::ptrdiff_t>(part.offset(left, row));
    std::copy(from, from + 3 * (right - left),
              image.rgb.begin() + static_cast<std::ptrdiff_t>(image.offset(x + left, y + row)));
  }
}

namespace {

// Means of 2 x 2 pixels: what nearly every picture needs, without a division.
Image halved(const Image& image) {
  Image small(std::max(1, image.width / 2), std::max(1, image.height / 2), {});
  for (int y = 0; y < small.height; ++y) {
    const std::uint8_t* above = &image.rgb[image.offset(0, 2 * y)];
    const std::uint8_t* below = &image.rgb[image.offset(0, 2 * y + 1)];
    std::uint8_t* out = &small.rgb[small.offset(0, y)];
    for (int x = 0; x < small.width; ++x, above += 6, below += 6, out += 3)
      for (int k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>((above[k] + above[k + 3] + below[k] + below[k + 3] + 2u) >> 2);
  }
  return small;
}

}  // namespace

Image downsample(const Image& image, int factor) {
  if (factor <= 1) return image;
  if (factor == 2 && image.width > 1 && image.height > 1) return halved(image);
  Image small(std::max(1, image.width / factor), std::max(1, image.height / factor), {});
  const unsigned count = static_cast<unsigned>(factor * factor);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      unsigned sum[3] = {count / 2, count / 2, count / 2};
      for (int dy = 0; dy < factor; ++dy) {
        const std::uint8_t* pixel = &image.rgb[image.offset(x * factor, y * factor + dy)];
        for (int k = 0; k < 3 * factor; k += 3) sum[0] += pixel[k], sum[1] += pixel[k + 1], sum[2] += pixel[k + 2];
      }
      small.set(x, y,
                {static_cast<std::uint8_t>(sum[0] / count), static_cast<std::uint8_t>(sum[1] / count),
                 static_cast<std::uint8_t>(sum[2] / count)});
    }
  }
  return small;
}

}  // namespace toile
