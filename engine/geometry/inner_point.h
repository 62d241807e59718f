// SPDX-License-Identifier: GPL-3.0-or-later
// Where in a polygon there is most room: for labels and marks.
#pragma once

#include "engine/core/types.h"

namespace toile {

struct InnerPoint {
  Vec2 at = Vec2::Zero();
  double clearance = 0.0;  // distance to the outline, > 0 inside; 0 if the polygon has no inside
};

bool inside_polygon(const std::vector<Vec2>& polygon, const Vec2& point);         // even-odd
double distance_to_polygon(const std::vector<Vec2>& polygon, const Vec2& point);  // to the outline, >= 0

// The point farthest from the outline, to about 2 % of the polygon's extent.
InnerPoint roomiest_point(const std::vector<Vec2>& polygon);

// Width and length, width <= length, of the narrowest rectangle round a polygon.
Vec2 least_box(const std::vector<Vec2>& polygon);

// The part of the line through `point` (inside) along unit `direction` that lies in the polygon: from .. to, with
// from <= 0 <= to measured along `direction` from the point. Both zero if the line does not leave the polygon.
std::array<double, 2> chord_through(const std::vector<Vec2>& polygon, const Vec2& point, const Vec2& direction);

}  // namespace toile
