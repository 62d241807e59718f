// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/stretch_legend.h"

#include <cstdio>
#include <string>

#include "engine/render/palette.h"

namespace toile {

namespace {
constexpr double kText = 10.0, kBarWidth = 22.0;  // pixels

std::string percent(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%s%.3g %%", value > 0 ? "+" : "", 100 * value);
  return text;
}
}  // namespace

void draw_stretch_legend(Canvas& canvas, const Vec2& at, double height, double scale) {
  const double left = at.x(), right = left + kBarWidth, top = at.y() + 3 * kText, bottom = at.y() + height - kText;
  canvas.text({left, at.y() + 1.4 * kText}, kText, "stretch", kInk);
  constexpr int kBands = 128;
  for (int i = 0; i < kBands; ++i) {
    const double y0 = top + (bottom - top) * i / kBands, y1 = top + (bottom - top) * (i + 1) / kBands;
    const Rgb colour = stretch_colour(scale * (1.0 - 2.0 * (i + 0.5) / kBands), scale);
    canvas.fill({{left, y0}, {right, y0}, {right, y1}, {left, y1}}, colour);
  }
  canvas.line({{left, top}, {right, top}, {right, bottom}, {left, bottom}}, 1.0, kInk, true);
  for (int i = 0; i <= 4; ++i) {
    const double y = top + (bottom - top) * i / 4;
    canvas.line({{right, y}, {right + 5, y}}, 1.0, kInk);
    canvas.text({right + 9, y + 0.5 * kText}, kText, percent(scale * (1.0 - 0.5 * i)), kInk);
  }
}

}  // namespace toile
