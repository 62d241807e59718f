// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/fit_reflection.h"

#include <cmath>

namespace toile {

std::optional<Eigen::Matrix2d> fit_reflection(const std::vector<std::pair<Vec2, Vec2>>& pairs, const Vec2& from_centre,
                                              const Vec2& to_centre) {
  double c = 0.0, s = 0.0;
  for (const auto& [p, q] : pairs) {
    const Vec2 a = p - from_centre, b = q - to_centre;
    c += a.x() * b.x() - a.y() * b.y();
    s += a.y() * b.x() + a.x() * b.y();
  }
  const double length = std::hypot(c, s);
  if (length == 0.0) return std::nullopt;
  Eigen::Matrix2d reflection;
  reflection << c / length, s / length, s / length, -c / length;
  return reflection;
}

}  // namespace toile
