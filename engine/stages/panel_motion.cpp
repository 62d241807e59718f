// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/panel_motion.h"

#include <algorithm>
#include <cmath>

namespace toile {

PanelMotion::PanelMotion(const PatternMesh& mesh, const Points2& target, int panel)
    : mesh_(mesh), target_(target), range_(mesh.panels[static_cast<std::size_t>(panel)]) {
  gradients_.reserve(static_cast<std::size_t>(range_.triangle_end - range_.triangle_begin));
  for (int f = range_.triangle_begin; f < range_.triangle_end; ++f)
    gradients_.push_back(edges(target_, f) * edges(mesh_.rest, f).inverse());
}

Mat2 PanelMotion::at_vertex(int v) const {
  Mat2 sum = Mat2::Zero();
  double area = 0.0;
  for (int f = range_.triangle_begin; f < range_.triangle_end; ++f)
    for (int k = 0; k < 3; ++k)
      if (mesh_.triangles(f, k) == v) {
        sum += area_of(f) * gradient(f);
        area += area_of(f);
      }
  return area > 0 ? Mat2(sum / area) : Mat2(Mat2::Identity());
}

Mat2 PanelMotion::around(const Vec2& point, double radius) const {
  Mat2 sum = Mat2::Zero();
  double area = 0.0;
  for (int f = range_.triangle_begin; f < range_.triangle_end; ++f) {
    const auto t = mesh_.triangles.row(f);
    if (((rest(t[0]) + rest(t[1]) + rest(t[2])) / 3.0 - point).norm() > radius) continue;
    sum += area_of(f) * gradient(f);
    area += area_of(f);
  }
  return area > 0 ? Mat2(sum / area) : gradient(triangle_at(point));
}

Vec2 PanelMotion::moved(const Vec2& point) const {
  const int f = triangle_at(point);
  return target_.row(mesh_.triangles(f, 0)).transpose() + gradient(f) * (point - rest(mesh_.triangles(f, 0)));
}

Mat2 PanelMotion::turn_at(const Vec2& point) const {
  const Mat2& g = gradient(triangle_at(point));
  const Vec2 polar(g(0, 0) + g(1, 1), g(1, 0) - g(0, 1));
  if (polar.norm() == 0.0) return Mat2::Identity();
  const Vec2 cs = polar.normalized();
  return (Mat2() << cs.x(), -cs.y(), cs.y(), cs.x()).finished();
}

Mat2 PanelMotion::edges(const Points2& points, int f) const {
  const auto t = mesh_.triangles.row(f);
  Mat2 m;
  m.col(0) = (points.row(t[1]) - points.row(t[0])).transpose();
  m.col(1) = (points.row(t[2]) - points.row(t[0])).transpose();
  return m;
}

double PanelMotion::area_of(int f) const {
  return 0.5 * std::abs(edges(mesh_.rest, f).determinant());
}

int PanelMotion::triangle_at(const Vec2& point) const {
  int best = range_.triangle_begin;
  double least = 1e300;
  for (int f = range_.triangle_begin; f < range_.triangle_end; ++f) {
    const Vec2 s = edges(mesh_.rest, f).inverse() * (point - rest(mesh_.triangles(f, 0)));
    const double outside = std::max({-s.x(), -s.y(), s.x() + s.y() - 1.0}) * std::sqrt(area_of(f));
    if (outside < least) least = outside, best = f;
    if (least <= 0.0) break;
  }
  return best;
}

}  // namespace toile
