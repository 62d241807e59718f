// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/render/stroke_font.h"

namespace toile {

namespace {
// Strokes of text are this much of the capital height wide: reads well from 7 pixels up.
constexpr double kTextWeight = 0.15;

bool finite(const std::vector<Vec2>& points) {
  return std::all_of(points.begin(), points.end(), [](const Vec2& p) { return p.allFinite(); });
}
}  // namespace

Canvas::Canvas(int width, int height, int supersample, Rgb background)
    : width_(width),
      height_(height),
      factor_(std::clamp(supersample, 1, 4)),
      samples_(width * factor_, height * factor_, background) {}

// Scan lines through sample centres; a sample is inside when an odd number of edges lies to its left.
void Canvas::fill_samples(const std::vector<Vec2>& polygon, Rgb colour) {
  if (polygon.size() < 3 || !finite(polygon)) return;
  double low = polygon[0].y(), high = low;
  for (const Vec2& p : polygon) low = std::min(low, p.y()), high = std::max(high, p.y());
  const int first = static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, double(samples_.height)));
  const int last = static_cast<int>(std::clamp(std::ceil(high - 0.5), 0.0, double(samples_.height)));
  std::vector<double> crossings;
  for (int row = first; row < last; ++row) {
    const double y = row + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y() <= y) != (b.y() <= y)) crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double limit = samples_.width;
      const int begin = static_cast<int>(std::clamp(std::ceil(crossings[i] - 0.5), 0.0, limit));
      const int end = static_cast<int>(std::clamp(std::ceil(crossings[i + 1] - 0.5), 0.0, limit));
      for (int x = begin; x < end; ++x) samples_.set(x, row, colour);
    }
  }
}

void Canvas::fill_disc(const Vec2& centre, double radius, Rgb colour) {
  const int sides = std::clamp(static_cast<int>(4 * radius), 8, 64);
  std::vector<Vec2> disc;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    disc.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  fill_samples(disc, colour);
}

void Canvas::fill(const std::vector<Vec2>& polygon, Rgb colour) {
  std::vector<Vec2> scaled;
  scaled.reserve(polygon.size());
  for (const Vec2& p : polygon) scaled.emplace_back(p * factor_);
  fill_samples(scaled, colour);
}

void Canvas::line(const std::vector<Vec2>& points, double width, Rgb colour, bool closed) {
  if (points.empty() || !finite(points)) return;
  const double half = 0.5 * width * factor_;
  const std::size_t count = points.size(), segments = closed ? count : count - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec2 a = points[i] * factor_, b = points[(i + 1) % count] * factor_;
    const double length = (b - a).norm();
    if (length <= 0) continue;
    const Vec2 across = half / length * Vec2(-(b - a).y(), (b - a).x());
    fill_samples({a + across, b + across, b - across, a - across}, colour);
  }
  for (const Vec2& p : points) fill_disc(p * factor_, half, colour);
}

void Canvas::dashed_line(const std::vector<Vec2>& points, double width, Rgb colour, double dash, double gap) {
  const double period = dash + gap;
  if (points.size() < 2 || !finite(points) || !(period > 0)) return;
  double along = 0.0;  // arc length at the start of the segment
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = (points[i + 1] - points[i]).norm();
    if (length <= 0) continue;
    const auto at = [&](double s) -> Vec2 { return points[i] + (s - along) / length * (points[i + 1] - points[i]); };
    for (double start = std::floor(along / period) * period; start < along + length; start += period) {
      const double from = std::max(start, along), to = std::min(start + dash, along + length);
      if (from < to) line({at(from), at(to)}, width, colour);
    }
    along += length;
  }
}

void Canvas::circle(const Vec2& centre, double radius, double width, Rgb colour) {
  std::vector<Vec2> points;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 48;
    points.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  line(points, width, colour, true);
}

void Canvas::text(const Vec2& at, double height, std::string_view text, Rgb colour, Anchor anchor, double angle) {
  const double shift = anchor == Anchor::Left ? 0.0 : anchor == Anchor::Middle ? 0.5 : 1.0;
  const double left = -shift * text_width(text, height);
  const Vec2 along(std::cos(angle), -std::sin(angle)), up(-std::sin(angle), -std::cos(angle));
  for (auto& stroke : text_strokes(text, height)) {
    for (Vec2& p : stroke) p = at + (left + p.x()) * along + p.y() * up;
    line(stroke, kTextWeight * height, colour);
  }
}

void Canvas::paste_supersampled(const Image& part, int x, int y) {
  paste(samples_, part, x * factor_, y * factor_);
}

}  // namespace toile
