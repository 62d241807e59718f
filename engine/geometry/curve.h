// SPDX-License-Identifier: GPL-3.0-or-later
// Plane curves from a start to an end point: points, arc length, even sampling, enclosed area, reversal.
//
// Parameter t in [0, 1] from start to end; for arcs and polylines it is proportional to arc length. Lengths in the
// unit of the points. Bézier lengths are Gauss-Legendre quadratures, relative error below 1e-9 on curves without cusps.
#pragma once

#include <vector>

#include "engine/core/pattern.h"
#include "engine/core/types.h"

namespace toile {

struct Curve {
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  EdgeCurve shape;
};

// An arc as centre, start angle and signed sweep (positive is counter-clockwise), radians.
struct ArcGeometry {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
  double start_angle = 0.0;
  double sweep = 0.0;
};

Curve edge_curve(const Panel& panel, int edge);

Vec2 curve_point(const Curve& curve, double t);
Vec2 curve_derivative(const Curve& curve, double t);  // d point / d t
double curve_length(const Curve& curve);

// `segments` + 1 points, evenly spaced by arc length, both ends exact. segments >= 1.
std::vector<Vec2> sample_curve(const Curve& curve, int segments);

// Points at the given fractions of the arc length, each in [0, 1], ascending.
std::vector<Vec2> curve_points_at(const Curve& curve, const std::vector<double>& fractions);

// The parameters t of the points at these fractions of the arc length.
std::vector<double> curve_parameters_at(const Curve& curve, const std::vector<double>& fractions);

inline constexpr int kMostFlattenChords = 512;

// Points such that the chain of chords stays within `tolerance` of the curve; both ends included. Of a Bézier or arc at
// most `most_chords` chords, evenly spaced in t: one that needs more is met less closely.
std::vector<Vec2> flatten_curve(const Curve& curve, double tolerance, int most_chords = kMostFlattenChords);

// Half the integral of (x dy - y dx) along the curve: summed round a closed outline it is the signed area.
double curve_signed_area(const Curve& curve);

// The same way walked from end to start.
Curve reversed(const Curve& curve);

// The radius is raised to half the chord where it is smaller. The chord must not be zero.
ArcGeometry arc_geometry(const Curve& curve);

double edge_length(const Panel& panel, int edge);
double outline_signed_area(const Panel& panel);  // > 0: counter-clockwise

// The outline as a closed polygon, first point not repeated, within `tolerance` of the curves.
std::vector<Vec2> flatten_outline(const Panel& panel, double tolerance);

}  // namespace toile
