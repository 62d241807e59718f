// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of curves: where a point lies on a curve, and the curve between two of its places. Unit of the points.
#pragma once

#include "engine/geometry/curve.h"

namespace toile {

struct CurvePlace {
  double t = 0.0;         // parameter of the nearest point, [0, 1]
  double distance = 0.0;  // to it
};
CurvePlace nearest_on_curve(const Curve& curve, const Vec2& point);

// The way from parameter `from` to `to` > `from` as a curve of the same kind; exact.
Curve part_of_curve(const Curve& curve, double from, double to);

}  // namespace toile
