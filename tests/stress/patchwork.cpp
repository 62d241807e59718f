// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/patchwork.h"

#include <algorithm>
#include <numbers>

#include "tests/support/tubes.h"

namespace toile::stress {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// Puts a panel upright, its middle at `angle` round the axis (0 in front, growing towards the wearer's left).
void place(Panel& panel, double angle, double middle_x, double bottom, double distance) {
  panel.rotation = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
  panel.translation = panel.rotation * Vec3(-middle_x, 0, distance) + Vec3(0, bottom, 0);
}

EdgeCurve hem_with_doubled_points(const Vec2& from, const Vec2& to) {
  EdgeCurve curve;
  curve.kind = CurveKind::Polyline;
  for (const double at : {0.25, 0.25, 0.5, 0.5, 0.75, 0.75}) curve.points.push_back(from + at * (to - from));
  return curve;
}

class Builder {
 public:
  explicit Builder(const Patchwork& p) : p_(p) {
    for (int c = 0; c < p.columns; ++c) widths_.push_back(p.sliver > 0 && c % 3 == 1 ? p.sliver : 0.0);
    double given = p.godet;
    int free = 0;
    for (const double width : widths_) given += width, free += width == 0.0;
    for (double& width : widths_)
      if (width == 0.0) width = std::max(0.01, (p.girth - given) / free);
  }

  Pattern build() {
    pattern_.name = "patchwork";
    pattern_.fabric = p_.fabric;
    for (int r = 0; r < p_.rows; ++r) add_row(r);
    for (int r = 0; r + 1 < p_.rows; ++r)
      for (int c = 0; c < p_.columns; ++c) join(panel(r, c), top_edge(), panel(r + 1, c), 0);
    return pattern_;
  }

 private:
  int panel(int row, int column) const { return first_of_row_[static_cast<std::size_t>(row)] + column; }
  bool split() const { return p_.short_seam > 0; }
  int top_edge() const { return split() ? 3 : 2; }
  int left_edge() const { return split() ? 4 : 3; }

  void join(int a, int edge_a, int b, int edge_b) {
    pattern_.seams.push_back({{PanelId(a), edge_a}, {PanelId(b), edge_b}, false});
  }

  // Corners counter-clockwise: bottom left, bottom right, (where the short seam begins,) top right, top left, (...).
  Panel rectangle(const std::string& name, double width, double height) const {
    const double lean = std::tan(p_.shear) * height, low = (height - p_.short_seam) / height;
    Panel panel;
    panel.name = name;
    panel.corners = {{0, 0}, {width, 0}};
    if (split()) panel.corners.emplace_back(width + low * lean, low * height);
    panel.corners.emplace_back(width + lean, height);
    panel.corners.emplace_back(lean, height);
    if (split()) panel.corners.emplace_back(low * lean, low * height);
    panel.edges.resize(panel.corners.size());
    return panel;
  }

  void add_row(int r) {
    first_of_row_.push_back(static_cast<int>(pattern_.panels.size()));
    const double height = p_.height / p_.rows, wider = std::pow(p_.gather, r);
    double round = 0.0;
    for (int c = 0; c < p_.columns; ++c) {
      const double width = widths_[static_cast<std::size_t>(c)];
      Panel panel = rectangle("panel_" + std::to_string(r) + "_" + std::to_string(c), wider * width, height);
      const double lean = std::tan(p_.shear) * height;
      place(panel, kTwoPi * (round + 0.5 * width) / p_.girth, 0.5 * (wider * width + lean), p_.bottom + r * height,
            p_.distance);
      round += width;
      if (r + 1 == p_.rows) panel.edges[static_cast<std::size_t>(top_edge())].label = "lower_interface";
      if (r == 0 && p_.doubled_points)
        panel.edges[0].curve = hem_with_doubled_points(panel.corners[0], panel.corners[1]);
      pattern_.panels.push_back(std::move(panel));
    }
    const bool with_godet = p_.godet > 0 && r == 0 && !split();
    for (int c = with_godet ? 1 : 0; c < p_.columns; ++c) join_columns(panel(r, c), panel(r, (c + 1) % p_.columns));
    if (with_godet) add_godet(height);
  }

  void join_columns(int a, int b) {
    join(a, 1, b, left_edge());
    if (split()) {
      pattern_.seams.pop_back();
      join(a, 1, b, 5), join(a, 2, b, 4);
    }
  }

  // A triangle as high as its neighbours' sides: the needle's tip is at the top.
  void add_godet(double height) {
    const double leg = height / std::cos(p_.shear);
    Panel needle;
    needle.name = "godet";
    needle.corners = {{0, 0}, {p_.godet, 0}, {0.5 * p_.godet, std::sqrt(leg * leg - 0.25 * p_.godet * p_.godet)}};
    needle.edges.resize(3);
    place(needle, kTwoPi * widths_[0] / p_.girth, 0.5 * p_.godet, p_.bottom, p_.distance);
    const int number = static_cast<int>(pattern_.panels.size());
    pattern_.panels.push_back(std::move(needle));
    join(panel(0, 0), 1, number, 2);
    join(number, 1, panel(0, 1), left_edge());
  }

  const Patchwork& p_;
  std::vector<double> widths_;
  std::vector<int> first_of_row_;
  Pattern pattern_;
};

}  // namespace

Body make_body(const FormShape& s) {
  const auto radius = [&](double y) {
    const double away = (y / s.height - s.bulge_at) / 0.18;
    return s.radius * (1.0 + s.bulge * std::exp(-away * away));
  };
  Body body = test::tube_body("form", radius, s.height, s.around, s.rings);
  body.surface.vertices.col(2) *= s.depth;
  return body;
}

double girth(const FormShape& s) {
  const double a = s.radius, b = s.radius * s.depth, h = (a - b) * (a - b) / ((a + b) * (a + b));
  return std::numbers::pi * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));  // Ramanujan's ellipse
}

Pattern make_pattern(const Patchwork& patchwork) {
  return Builder(patchwork).build();
}

Fabric random_fabric(test::Dice& dice, bool wild) {
  if (!wild) {
    const std::vector<std::string> names = fabric_names();
    return *fabric_named(names[static_cast<std::size_t>(dice.whole(0, static_cast<int>(names.size()) - 1))]);
  }
  Fabric fabric;
  fabric.name = "custom";
  fabric.weft_stiffness = dice.by_decades(1.0, 1e6);
  fabric.warp_stiffness = dice.by_decades(1.0, 1e6);
  fabric.shear_stiffness = dice.by_decades(0.1, 1e5);
  fabric.bending_stiffness = dice.chance(0.1) ? 0.0 : dice.by_decades(1e-8, 1e-2);
  fabric.density = dice.by_decades(0.005, 5.0);
  return fabric;
}

}  // namespace toile::stress
