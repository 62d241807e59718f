// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/record_json.h"
#include "engine/io/toile_block.h"

namespace toile {

using nlohmann::json;

namespace {

constexpr double kUnit = kMetrePerCm;

// Angles of R = Rz Ry Rx in degrees. At gimbal lock (ry = +-90) rz is taken as zero.
Vec3 degrees_of_rotation(const Mat3& r) {
  const double sin_y = std::clamp(-r(2, 0), -1.0, 1.0);
  Vec3 angles;
  if (std::abs(sin_y) < 1.0 - 1e-12) {
    angles = {std::atan2(r(2, 1), r(2, 2)), std::asin(sin_y), std::atan2(r(1, 0), r(0, 0))};
  } else {
    angles = {std::atan2(sin_y * r(0, 1), r(1, 1)), std::asin(sin_y), 0.0};
  }
  return angles * kDegreePerRadian;
}

json relative(const Vec2& point, const Vec2& start, const Vec2& end) {
  const Vec2 chord = end - start, normal(-chord.y(), chord.x()), offset = point - start;
  return {offset.dot(chord) / chord.squaredNorm(), offset.dot(normal) / chord.squaredNorm()};
}

json curvature_json(const EdgeCurve& curve, const Vec2& start, const Vec2& end) {
  switch (curve.kind) {
    case CurveKind::Line: return nullptr;
    case CurveKind::QuadraticBezier:
      return {{"type", "quadratic"}, {"params", json::array({relative(curve.control[0], start, end)})}};
    case CurveKind::CubicBezier:
      return {{"type", "cubic"},
              {"params", {relative(curve.control[0], start, end), relative(curve.control[1], start, end)}}};
    case CurveKind::Arc:
      return {{"type", "circle"},
              {"params", {curve.radius / kUnit, curve.large_arc ? 1 : 0, curve.bulges_right ? 1 : 0}}};
    case CurveKind::Polyline: {
      json points = json::array();
      for (const Vec2& point : curve.points) points.push_back(relative(point, start, end));
      return {{"type", "polyline"}, {"params", points}};
    }
  }
  return nullptr;
}

json panel_json(const Panel& panel) {
  const Vec3 degrees = degrees_of_rotation(panel.rotation), position = panel.translation / kUnit;
  json value = {{"translation", {position.x(), position.y(), position.z()}},
                {"rotation", {degrees.x(), degrees.y(), degrees.z()}},
                {"vertices", json::array()},
                {"edges", json::array()}};
  if (!panel.label.empty()) value["label"] = panel.label;
  for (int e = 0; e < panel.edge_count(); ++e) {
    const PanelEdge& edge = panel.edges[static_cast<std::size_t>(e)];
    const Vec2 corner = panel.edge_start(e) / kUnit;
    value["vertices"].push_back({corner.x(), corner.y()});
    json entry = {{"endpoints", {e, (e + 1) % panel.edge_count()}}};
    const json curvature = curvature_json(edge.curve, panel.edge_start(e), panel.edge_end(e));
    if (!curvature.is_null()) entry["curvature"] = curvature;
    if (!edge.label.empty()) entry["label"] = edge.label;
    value["edges"].push_back(entry);
  }
  return value;
}

json document_of(const Pattern& pattern) {
  json panels = json::object(), order = json::array(), stitches = json::array();
  for (const Panel& panel : pattern.panels) {
    panels[panel.name] = panel_json(panel);
    order.push_back(panel.name);
  }
  const auto side = [&](const SeamSide& s) -> json {
    return {{"panel", pattern.panel(s.panel).name}, {"edge", s.edge}};
  };
  for (const Seam& seam : pattern.seams) {
    json stitch = json::array({side(seam.a), side(seam.b)});
    if (seam.right_wrong) stitch.push_back("right_wrong");
    stitches.push_back(stitch);
  }
  json document = {{"pattern", {{"panels", panels}, {"stitches", stitches}, {"panel_order", order}}},
                   {"parameters", json::object()},
                   {"parameter_order", json::array()},
                   {"properties",
                    {{"curvature_coords", "relative"},
                     {"units_in_meter", 100},
                     {"normalize_panel_translation", false},
                     {"normalized_edge_loops", true}}}};
  const json block = write_toile_block(pattern, kUnit);
  if (!block.empty()) document["toile"] = block;
  return document;
}

}  // namespace

std::string write_garmentcode(const Pattern& pattern) {
  return document_of(pattern).dump(1) + "\n";
}

std::string write_altered_pattern(const Pattern& pattern, const Record& alteration) {
  json document = document_of(pattern);
  document["schema"] = "toile/altered_pattern/1";
  document["alteration"] = json::parse(write_json(alteration));
  return document.dump(1) + "\n";
}

}  // namespace toile
