// SPDX-License-Identifier: GPL-3.0-or-later
// The curve of a given kind that passes nearest to a row of points, its two ends held.
//
// Béziers: least squares over the control points across the curve, alternating with the nearest parameters of the
// points. Arcs: least squares over the height of the bulge. Same unit in and out.
#pragma once

#include <optional>
#include <vector>

#include "engine/geometry/curve.h"

namespace toile {

struct CurveFit {
  Curve curve;
  double deviation = 0.0;  // largest distance of a point from the curve
};

// Unit vectors along which a cubic is to leave its start and to reach its end; empty: as fits best.
struct EndDirections {
  std::optional<Vec2> start = {}, end = {};
};

// `guess` gives the kind, the ends and a first shape, which also settles what too few points leave open; `points` are
// interior points in order from start to end, `parameters` their first parameters t, one each. Polylines take the
// points; `directions` count for cubics alone.
CurveFit fit_curve(const Curve& guess, const std::vector<Vec2>& points, const std::vector<double>& parameters,
                   const EndDirections& directions = {});

// The curve carried along as its two ends move: scaled, turned and shifted, never mirrored.
Curve carried(const Curve& curve, const Vec2& start, const Vec2& end);

// The same way drawn as a cubic Bézier; lines and quadratics exactly, arcs up to a half circle within 0.03 % of the
// radius.
Curve as_cubic(const Curve& curve);

// Distance of a point from the curve, and the nearest parameter found from `t`.
std::pair<double, double> distance_to_curve(const Curve& curve, const Vec2& point, double t);

}  // namespace toile
