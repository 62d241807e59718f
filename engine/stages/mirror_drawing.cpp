// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/mirror_drawing.h"

#include <algorithm>

namespace toile {
namespace {

// A reflection of the plane.
struct Reflection {
  Mat2 turn;
  Vec2 offset;
  Vec2 operator()(const Vec2& p) const { return turn * p + offset; }
};

// The image of a curve, walked from the image of its end to that of its start. An arc's bulge is turned over twice.
EdgeCurve image_of(const EdgeCurve& curve, const Reflection& reflect) {
  EdgeCurve image = curve;
  for (Vec2& control : image.control) control = reflect(control);
  if (curve.kind == CurveKind::CubicBezier) std::swap(image.control[0], image.control[1]);
  for (Vec2& point : image.points) point = reflect(point);
  std::reverse(image.points.begin(), image.points.end());
  return image;
}

Vec2 mean(const Vec2& a, const Vec2& b) {
  return 0.5 * (a + b);
}

// Of two curves of one kind between the same ends; of two kinds the one that bends more freely.
EdgeCurve mean(const EdgeCurve& a, const EdgeCurve& b) {
  if (a.kind != b.kind || a.points.size() != b.points.size()) return a.kind > b.kind ? a : b;
  EdgeCurve result = a;
  for (std::size_t i = 0; i < result.control.size(); ++i) result.control[i] = mean(a.control[i], b.control[i]);
  for (std::size_t i = 0; i < result.points.size(); ++i) result.points[i] = mean(a.points[i], b.points[i]);
  result.radius = 0.5 * (a.radius + b.radius);
  return result;
}

// The panel's own image, edge for edge: the edge that takes the place of `e` comes from the edge that `e` goes to.
Panel image_panel(const Panel& panel, const PanelImage& image, const Reflection& reflect, Panel onto) {
  const std::size_t n = panel.edges.size();
  for (std::size_t e = 0; e < n; ++e) {
    const auto there = static_cast<std::size_t>(image.edge_of[e]);
    onto.corners[there] = reflect(panel.corners[(e + 1) % n]);
    onto.edges[there].curve = image_of(panel.edges[e].curve, reflect);
  }
  return onto;
}

// Notches at mirrored places before stay at mirrored places: both take the first one's.
void mirror_notches(const Panel& panel, const PanelImage& image, const Panel& before, Panel& onto) {
  constexpr double kSamePlace = 1e-6;
  for (std::size_t i = 0; i < panel.notches.size(); ++i)
    for (std::size_t j = 0; j < onto.notches.size(); ++j)
      if (onto.notches[j].edge == image.edge_of[static_cast<std::size_t>(panel.notches[i].edge)] &&
          std::abs(before.notches[j].at - (1.0 - panel.notches[i].at)) < kSamePlace)
        onto.notches[j].at = 1.0 - panel.notches[i].at;
}

// Where the image of the panel lies, from one vertex and its image.
Reflection reflection_of(const PatternMesh& mesh, const GarmentMirrors& mirrors, const Points2& rest, int panel) {
  const PanelImage& image = mirrors.panels[static_cast<std::size_t>(panel)];
  const PanelRange& range = mesh.panels[static_cast<std::size_t>(panel)];
  Vec2 offset = Vec2::Zero();
  for (int v = range.vertex_begin; v < range.vertex_end; ++v)
    offset +=
        rest.row(mirrors.vertex[static_cast<std::size_t>(v)]).transpose() - image.reflection * rest.row(v).transpose();
  return {image.reflection, offset / (range.vertex_end - range.vertex_begin)};
}

}  // namespace

void mirror_drawing(const PatternMesh& mesh, const GarmentMirrors& mirrors, const Points2& rest, Pattern& drawn) {
  for (int p = 0; p < static_cast<int>(mirrors.panels.size()); ++p) {
    const PanelImage& image = mirrors.panels[static_cast<std::size_t>(p)];
    const int first = mesh.panels[static_cast<std::size_t>(p)].vertex_begin;
    if (image.panel < p || mirrors.vertex[static_cast<std::size_t>(first)] < 0) continue;
    const Reflection reflect = reflection_of(mesh, mirrors, rest, p);
    Panel& panel = drawn.panels[static_cast<std::size_t>(p)];
    Panel& onto = drawn.panels[static_cast<std::size_t>(image.panel)];
    if (image.panel == p) {
      const Panel there = image_panel(panel, image, reflect, panel);
      for (std::size_t e = 0; e < panel.edges.size(); ++e) {
        panel.corners[e] = mean(panel.corners[e], there.corners[e]);
        panel.edges[e].curve = mean(panel.edges[e].curve, there.edges[e].curve);
      }
    }
    const Panel before = onto;
    onto = image_panel(panel, image, reflect, onto);
    mirror_notches(panel, image, before, onto);
  }
}

}  // namespace toile
