// SPDX-License-Identifier: GPL-3.0-or-later
// A sewing pattern as drawn: panels with curved edges, and how they join. Lengths in metres.
#pragma once

#include "engine/core/fabric.h"
#include "engine/core/ids.h"
#include "engine/core/types.h"

namespace toile {

enum class CurveKind { Line, QuadraticBezier, CubicBezier, Arc, Polyline };

// The way from an edge's start to its end. Control points are absolute, in the panel frame.
struct EdgeCurve {
  CurveKind kind = CurveKind::Line;
  std::array<Vec2, 2> control = {Vec2::Zero(), Vec2::Zero()};  // 1 used by quadratic, 2 by cubic
  double radius = 0.0;                                         // arc; at least half the chord
  bool large_arc = false;                                      // arc longer than a half circle
  bool bulges_right = false;                                   // arc runs counter-clockwise about its centre
  std::vector<Vec2> points;                                    // polyline: between start and end, neither included
};

// Edge k of a panel runs from corners[k] to corners[(k + 1) % size].
struct PanelEdge {
  EdgeCurve curve;
  std::string label;  // of the file: "lower_interface", "left_armhole", ... or empty
  std::string name;   // in human words, from the `toile` block, or empty
  std::optional<double> seam_allowance;
  std::optional<double> hem;  // depth of the hem turned up at this edge
  bool locked = false;        // shape must not change (pocket mouth, facing)
  bool zip = false;           // carries a zip: locked, and its seam is not opened
  std::optional<bool> straight;  // must stay straight / may bend; empty: detected
  bool on_fold = false;          // centre line on which the panel is cut folded: no seam allowance
};

enum class NotchType { V, T, Castle, Check, U };

struct Notch {
  int edge = 0;
  double at = 0.0;  // fraction of the edge's arc length from its start, 0..1
  NotchType type = NotchType::V;
};

// A region of a panel that no cut, insertion or removal may enter (pocket, print).
struct KeepOut {
  std::vector<Vec2> polygon;
  std::string why;
};

struct Panel {
  std::string name;
  std::string label;          // body part it may touch: "body", "arm", "leg", or empty
  std::vector<Vec2> corners;  // outline corners in the order of the file
  std::vector<PanelEdge> edges;
  Mat3 rotation = Mat3::Identity();  // placement around the reference body: world = rotation * (x, y, 0) + translation
  Vec3 translation = Vec3::Zero();
  std::vector<Notch> notches;
  std::vector<KeepOut> keep_outs;
  std::optional<std::array<Vec2, 2>> grainline;  // warp direction, from [0] to [1]; empty: +y
  int quantity = 1;
  std::string material;
  std::string piece_label;  // printed on the piece, from the `toile` block, or empty
  bool locked = false;

  int edge_count() const { return static_cast<int>(edges.size()); }
  const Vec2& edge_start(int edge) const { return corners[static_cast<std::size_t>(edge)]; }
  const Vec2& edge_end(int edge) const { return corners[static_cast<std::size_t>(edge + 1) % corners.size()]; }
};

struct SeamSide {
  PanelId panel;
  int edge = 0;
  bool operator==(const SeamSide&) const = default;
};

// Joins one whole edge to one whole edge; a dart joins two edges of one panel. Unequal lengths are eased evenly by arc
// length. The start of `a` meets the end of `b`; with `right_wrong` start meets start (one piece lies inside out).
struct Seam {
  SeamSide a;
  SeamSide b;
  bool right_wrong = false;
};

struct Pattern {
  std::string name;
  std::vector<Panel> panels;
  std::vector<Seam> seams;
  Fabric fabric;
  double seam_allowance = 0.01;  // where an edge does not say otherwise
  std::vector<SeamSide> pins;    // edges held in place while draping

  enum class Symmetry { None, Auto, Plane } symmetry = Symmetry::Auto;
  std::array<double, 4> symmetry_plane = {1, 0, 0, 0};  // a x + b y + c z = d, world frame; used with Plane

  const Panel& panel(PanelId id) const { return panels[static_cast<std::size_t>(id.value)]; }
  Panel& panel(PanelId id) { return panels[static_cast<std::size_t>(id.value)]; }
  const PanelEdge& edge(const SeamSide& side) const {
    return panel(side.panel).edges[static_cast<std::size_t>(side.edge)];
  }
};

}  // namespace toile
