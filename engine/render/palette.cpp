// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/palette.h"

#include <algorithm>
#include <cmath>

namespace toile {

Rgb mix(Rgb a, Rgb b, double t) {
  const auto channel = [t](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1 - t) * from + t * to));
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

Rgb stretch_colour(double stretch, double scale) {
  static constexpr std::array<Rgb, 5> kStops = {Rgb{38, 62, 200}, Rgb{60, 175, 205}, Rgb{85, 175, 85},
                                                Rgb{242, 208, 70}, Rgb{208, 38, 34}};
  if (!std::isfinite(stretch) || !(scale > 0)) return {128, 128, 128};
  const double position = 2.0 + 2.0 * std::clamp(stretch / scale, -1.0, 1.0);
  const auto below = static_cast<std::size_t>(std::min(3.0, std::floor(position)));
  return mix(kStops[below], kStops[below + 1], position - static_cast<double>(below));
}

Rgb panel_colour(int index) {
  static constexpr std::array<Rgb, 12> kColours = {Rgb{66, 139, 214},  Rgb{240, 164, 50},  Rgb{84, 178, 96},
                                                   Rgb{214, 84, 74},   Rgb{152, 104, 196}, Rgb{72, 184, 176},
                                                   Rgb{232, 122, 170}, Rgb{140, 150, 56},  Rgb{170, 126, 88},
                                                   Rgb{108, 112, 198}, Rgb{214, 200, 84},  Rgb{120, 134, 150}};
  return kColours[static_cast<std::size_t>(index < 0 ? 0 : index) % kColours.size()];
}

}  // namespace toile
