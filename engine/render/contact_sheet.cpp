// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "engine/render/canvas.h"
#include "engine/render/palette.h"
#include "engine/render/stretch_legend.h"
#include "engine/render/stroke_font.h"

namespace toile {
namespace {

constexpr int kGap = 12;           // pixels between views and round the sheet
constexpr double kCaption = 11.0;  // capital height of captions, pixels

struct Layout {
  std::vector<Camera> cameras;
  std::vector<int> left;  // of each view
  int top = 0, width = 0, height = 0, views_bottom = 0;
};

double scale_of(const SheetOptions& options) {
  const double view_height = std::clamp(options.view_height, 16, 4096);
  const double view_width = std::clamp(options.max_view_width, 16, 4096);
  if (options.frame.empty()) return 1.0 / view_height;
  const Vec3 size = options.frame.high - options.frame.low;
  return std::max({size.y() / view_height, size.x() / view_width, size.z() / view_width, 1e-6});
}

Layout lay_out(const SheetOptions& options) {
  Layout layout;
  layout.top = options.title.empty() ? kGap : 2 * kGap + static_cast<int>(1.5 * kCaption);
  int x = kGap, tallest = 16;
  for (const View view : options.views) {
    layout.cameras.push_back(camera_for(view, options.frame, scale_of(options)));
    layout.left.push_back(x);
    x += layout.cameras.back().width + kGap;
    tallest = std::max(tallest, layout.cameras.back().height);
  }
  if (options.stretch_scale) x += kStretchLegendWidth + kGap, tallest = std::max(tallest, 160);
  layout.views_bottom = layout.top + tallest;
  layout.width = std::max({x, 120, 2 * kGap + static_cast<int>(text_width(options.title, 1.25 * kCaption)) + 1});
  layout.height = layout.views_bottom + 2 * kGap + static_cast<int>(kCaption);
  return layout;
}

void draw_mark(Canvas& canvas, const Layout& layout, const Mark& mark) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < layout.cameras.size(); ++i)
    if (mark.normal.dot(layout.cameras[i].towards) > mark.normal.dot(layout.cameras[best].towards) + 1e-9) best = i;
  const Camera& camera = layout.cameras[best];
  const Vec3 at = camera.project(mark.point);
  if (!at.allFinite() || at.x() < 0 || at.y() < 0 || at.x() > camera.width || at.y() > camera.height) return;
  const Vec2 centre(layout.left[best] + at.x(), layout.top + at.y());
  canvas.circle(centre, 11, 4.0, kWhite);
  canvas.circle(centre, 11, 1.8, kInk);
  const double width = text_width(mark.text, kCaption);
  const bool to_left = at.x() + 16 + width > camera.width;
  const Vec2 text = centre + Vec2(to_left ? -16 - width : 16, 0.5 * kCaption);
  canvas.fill({text + Vec2(-3, 4), text + Vec2(width + 3, 4), text + Vec2(width + 3, -kCaption - 4),
               text + Vec2(-3, -kCaption - 4)},
              kWhite);
  canvas.text(text, kCaption, mark.text, kInk);
}

}  // namespace

Image contact_sheet(const std::vector<Surface>& surfaces, const SheetOptions& options) {
  const Layout layout = lay_out(options);
  Canvas canvas(layout.width, layout.height, options.supersample, kWhite);
  for (std::size_t i = 0; i < layout.cameras.size(); ++i) {
    const Camera& camera = layout.cameras[i];
    if (!options.frame.empty())
      canvas.paste_supersampled(paint(surfaces, camera, canvas.supersample(), kWhite), layout.left[i], layout.top);
    canvas.text({layout.left[i] + 0.5 * camera.width, layout.views_bottom + kGap + kCaption}, kCaption,
                view_name(options.views[i]), kFaintInk, Anchor::Middle);
  }
  if (!options.title.empty()) canvas.text({kGap, kGap + 1.25 * kCaption}, 1.25 * kCaption, options.title, kInk);
  if (options.stretch_scale) {
    const Vec2 corner(layout.width - kGap - kStretchLegendWidth, layout.top);
    draw_stretch_legend(canvas, corner, std::min(360, layout.views_bottom - layout.top), *options.stretch_scale);
  }
  if (!layout.cameras.empty())
    for (const Mark& mark : options.marks) draw_mark(canvas, layout, mark);
  return canvas.finish();
}

}  // namespace toile
