// SPDX-License-Identifier: GPL-3.0-or-later
// Quantiles of values that count by a weight: by area, mostly.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace toile {

using WeightedValues = std::vector<std::pair<double, double>>;  // value, weight >= 0

// The least value at which `share` (0..1) of the whole weight is reached; 0 of none. Sorts `values`.
inline double weighted_quantile(WeightedValues& values, double share) {
  std::sort(values.begin(), values.end());
  double all = 0.0, passed = 0.0;
  for (const auto& [value, weight] : values) all += weight;
  for (const auto& [value, weight] : values)
    if ((passed += weight) >= share * all) return value;
  return values.empty() ? 0.0 : values.back().first;
}

}  // namespace toile
