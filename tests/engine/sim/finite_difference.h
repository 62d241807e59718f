// SPDX-License-Identifier: GPL-3.0-or-later
// Central differences of an energy against its gradient, along random directions.
#pragma once

#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "engine/core/types.h"

namespace toile::test {

using EnergyFunction = std::function<double(const Points3& nodes, Points3& gradient)>;

inline Points3 random_points(int count, double range, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-range, range);
  Points3 points(count, 3);
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = uniform(random);
  return points;
}

// Requires a gradient that is not zero at `nodes`, so that the check cannot pass by accident.
inline void expect_gradient(const EnergyFunction& energy, const Points3& nodes, double step = 1e-6,
                            double tolerance = 1e-6) {
  Points3 gradient = Points3::Zero(nodes.rows(), 3), ignored = gradient;
  energy(nodes, gradient);
  ASSERT_GT(gradient.norm(), 1e-9);
  for (unsigned k = 0; k < 8; ++k) {
    const Points3 direction = random_points(static_cast<int>(nodes.rows()), 1.0, 100 + k);
    const double forward = energy(nodes + step * direction, ignored), back = energy(nodes - step * direction, ignored);
    const double exact = gradient.cwiseProduct(direction).sum();
    EXPECT_NEAR((forward - back) / (2 * step), exact, tolerance * gradient.norm() * direction.norm());
  }
}

}  // namespace toile::test
