// SPDX-License-Identifier: GPL-3.0-or-later
// The reflection of the plane that comes nearest to a set of pairs of points.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/core/types.h"

namespace toile {

// The 2 x 2 reflection F that makes the sum of |F (p - from_centre) - (q - to_centre)|^2 over the pairs (p, q) least.
// Empty where every reflection is as good as the other.
std::optional<Eigen::Matrix2d> fit_reflection(const std::vector<std::pair<Vec2, Vec2>>& pairs, const Vec2& from_centre,
                                              const Vec2& to_centre);

}  // namespace toile
