// SPDX-License-Identifier: GPL-3.0-or-later
// Exact small cases between points, edges and triangles in space. Any lengths.
#pragma once

#include <optional>

#include "engine/core/types.h"

namespace toile {

// Closest points of two segments: at + s (to - at) on each, s and t in [0, 1].
struct SegmentPair {
  double s = 0.0, t = 0.0;
  Vec3 apart = Vec3::Zero();  // point on the first minus point on the second
};
// Parallel segments give one of their closest pairs; segments without length are points.
SegmentPair closest_points_of_segments(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s);

// Where segment pq passes through the inside of triangle abc; touching does not count.
struct Piercing {
  double s = 0.0;                   // along pq
  Vec3 barycentric = Vec3::Zero();  // of a, b, c
};
std::optional<Piercing> pierce(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace toile
