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

constexpr int kViewGap = 12;       // pixels between views and round the sheet
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
  layout.top = options.title.empty() ? kViewGap : 2 * kViewGap + static_cast<int>(1.5 * kCaption);
  int x = kViewGap, tallest = 16;
  for (const View view : options.views) {
    layout.cameras.push_back(camera_for(view, options.frame, scale_of(options)));
    layout.left.push_back(x);
    x += layout.cameras.back().width + kViewGap;
    tallest = std::max(tallest, layout.cameras.back().height);
  }
  if (options.stretch_scale) x += kStretchLegendWidth + kViewGap, tallest = std::max(tallest, 160);
  layout.views_bottom = layout.top + tallest;
  layout.width = std::max({x, 120, 2 * kViewGap + static_cast<int>(text_width(options.title, 1.25 * kCaption)) + 1});
  layout.height = layout.views_bottom + 2 * kViewGap + static_cast<int>(kCaption);
  return layout;
}

constexpr double kMarkRadius = 11.0;  // pixels

bool in_range(const Surface& surface, int f) {
  return surface.triangles.row(f).minCoeff() >= 0 && surface.triangles.row(f).maxCoeff() < surface.vertices.rows();
}

// Is something more than a fingertip in front of the point?
bool hidden(const std::vector<Surface>& surfaces, const Camera& camera, const Vec3& point) {
  constexpr double kFingertip = 0.01;  // m
  const Vec3 at = camera.project(point);
  const auto covers_nearer = [&](const std::array<Vec3, 3>& p) {
    const auto side = [&](const Vec3& a, const Vec3& b) {
      return (b.x() - a.x()) * (at.y() - a.y()) - (b.y() - a.y()) * (at.x() - a.x());
    };
    const double u = side(p[1], p[2]), v = side(p[2], p[0]), w = side(p[0], p[1]), area = u + v + w;
    const bool covers = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    return covers && area != 0 && (u * p[0].z() + v * p[1].z() + w * p[2].z()) / area > at.z() + kFingertip;
  };
  for (const Surface& surface : surfaces) {
    std::vector<Vec3> projected;
    for (int v = 0; v < surface.vertices.rows(); ++v) projected.push_back(camera.project(surface.vertices.row(v)));
    const auto corner = [&](int f, int k) { return projected[static_cast<std::size_t>(surface.triangles(f, k))]; };
    for (int f = 0; f < surface.triangles.rows(); ++f)
      if (in_range(surface, f) && covers_nearer({corner(f, 0), corner(f, 1), corner(f, 2)})) return true;
  }
  return false;
}

// The view that sees the mark most squarely, if one does.
std::optional<std::size_t> view_of(const std::vector<Surface>& surfaces, const Layout& layout, const Mark& mark) {
  std::optional<std::size_t> best;
  double squareness = 0.2;  // cosine: seen more obliquely it says nothing
  for (std::size_t i = 0; i < layout.cameras.size(); ++i) {
    const Camera& camera = layout.cameras[i];
    const Vec3 at = camera.project(mark.point);
    if (!at.allFinite() || at.x() < 0 || at.y() < 0 || at.x() > camera.width || at.y() > camera.height) continue;
    const double cosine = mark.normal.dot(camera.towards);
    if (cosine <= squareness + 1e-9 || hidden(surfaces, camera, mark.point)) continue;
    squareness = cosine, best = i;
  }
  return best;
}

// A mark's words on their ground, with the circle they belong to; pixels of the sheet.
struct MarkPlace {
  Vec2 centre, text, low, high;  // low, high: of the ground and the circle together

  MarkPlace(const Camera& camera, const Vec2& corner, const Mark& mark) {
    const Vec3 at = camera.project(mark.point);
    centre = corner + at.head<2>();
    const double width = text_width(mark.text, kCaption), beside = kMarkRadius + 5;
    const bool to_left = at.x() + beside + width > camera.width;
    text = centre + Vec2(to_left ? -beside - width : beside, 0.5 * kCaption);
    low = (text + Vec2(-3, -kCaption - 4)).cwiseMin(centre - Vec2::Constant(kMarkRadius));
    high = (text + Vec2(width + 3, 4)).cwiseMax(centre + Vec2::Constant(kMarkRadius));
  }
  bool meets(const MarkPlace& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

void draw_mark(Canvas& canvas, const MarkPlace& place, const std::string& words) {
  canvas.circle(place.centre, kMarkRadius, 4.0, kWhite);
  canvas.circle(place.centre, kMarkRadius, 1.8, kInk);
  const Vec2 low = place.text + Vec2(-3, 4), high = place.text + Vec2(text_width(words, kCaption) + 3, -kCaption - 4);
  canvas.fill({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, kWhite);
  canvas.text(place.text, kCaption, words, kInk);
}

void draw_marks(Canvas& canvas, const Layout& layout, const std::vector<Surface>& surfaces,
                const SheetOptions& options) {
  std::vector<MarkPlace> drawn;
  for (const Mark& mark : options.marks) {
    if (static_cast<int>(drawn.size()) >= options.marks_drawn) return;
    const auto view = view_of(surfaces, layout, mark);
    if (!view) continue;
    const MarkPlace place(layout.cameras[*view], Vec2(layout.left[*view], layout.top), mark);
    // Of two marks that would cover each other the more important one stays.
    if (std::any_of(drawn.begin(), drawn.end(), [&](const MarkPlace& other) { return place.meets(other); })) continue;
    draw_mark(canvas, place, mark.text);
    drawn.push_back(place);
  }
}

}  // namespace

Image contact_sheet(const std::vector<Surface>& surfaces, const SheetOptions& options) {
  const Layout layout = lay_out(options);
  Canvas canvas(layout.width, layout.height, options.supersample, kWhite);
  for (std::size_t i = 0; i < layout.cameras.size(); ++i) {
    const Camera& camera = layout.cameras[i];
    if (!options.frame.empty())
      canvas.paste_supersampled(paint(surfaces, camera, canvas.supersample(), kWhite), layout.left[i], layout.top);
    canvas.text({layout.left[i] + 0.5 * camera.width, layout.views_bottom + kViewGap + kCaption}, kCaption,
                view_name(options.views[i]), kFaintInk, Anchor::Middle);
  }
  if (!options.title.empty()) canvas.text({kViewGap, kViewGap + 1.25 * kCaption}, 1.25 * kCaption, options.title, kInk);
  if (options.stretch_scale) {
    const Vec2 corner(layout.width - kViewGap - kStretchLegendWidth, layout.top);
    draw_stretch_legend(canvas, corner, std::min(360, layout.views_bottom - layout.top), *options.stretch_scale);
  }
  draw_marks(canvas, layout, surfaces, options);
  return canvas.finish();
}

}  // namespace toile
