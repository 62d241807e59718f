// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/closest_features.h"

#include <algorithm>

namespace toile {
namespace {

constexpr double kParallel = 1e-10;  // squared sine below which segments count as parallel

double unit(double value) {
  return std::clamp(value, 0.0, 1.0);
}

}  // namespace

SegmentPair closest_points_of_segments(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const Vec3 u = q - p, v = s - r, w = p - r;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  SegmentPair pair;
  const double sine = uu * vv - uv * uv;
  if (uu <= 0) {
    pair.t = vv > 0 ? unit(vw / vv) : 0.0;
  } else if (vv <= 0) {
    pair.s = unit(-uw / uu);
  } else {
    pair.s = sine > kParallel * uu * vv ? unit((uv * vw - vv * uw) / sine) : 0.0;
    pair.t = (uv * pair.s + vw) / vv;
    if (pair.t < 0 || pair.t > 1) {
      pair.t = unit(pair.t);
      pair.s = unit((uv * pair.t - uw) / uu);
    }
  }
  pair.apart = w + pair.s * u - pair.t * v;
  return pair;
}

std::optional<Piercing> pierce(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double dp = n.dot(p - a), dq = n.dot(q - a);
  if (!(dp * dq < 0)) return {};
  Piercing found;
  found.s = dp / (dp - dq);
  const Vec3 at = p + found.s * (q - p);
  const Vec3 parts(n.dot((c - b).cross(at - b)), n.dot((a - c).cross(at - c)), n.dot((b - a).cross(at - a)));
  if (!(parts.minCoeff() > 0)) return {};
  found.barycentric = parts / parts.sum();
  return found;
}

}  // namespace toile
