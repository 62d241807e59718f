// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sewn_pattern.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/geometry/curve.h"

namespace toile {
namespace {

constexpr double kTold = 2e-3;  // m that are sewn in unseen

// By which a is longer than b and what is eased there, as drawn.
double mismatch(const SewnPattern& sewn, std::size_t s) {
  const auto length = [&](const SeamSide& side) { return edge_length(sewn.pattern.panel(side.panel), side.edge); };
  return length(sewn.pattern.seams[s].a) - length(sewn.pattern.seams[s].b) - sewn.seams[s].eased;
}

}  // namespace

double seam_mismatch(const SewnPattern& sewn) {
  double most = 0.0;
  for (std::size_t s = 0; s < sewn.seams.size(); ++s) most = std::max(most, std::abs(mismatch(sewn, s)));
  return most;
}

std::vector<std::string> unlike_seams(const SewnPattern& sewn) {
  std::vector<std::string> flags;
  for (std::size_t s = 0; s < sewn.seams.size(); ++s) {
    const double longer = mismatch(sewn, s);
    if (std::abs(longer) < kTold) continue;
    std::string a = sewn.pattern.panel(sewn.pattern.seams[s].a.panel).name,
                b = sewn.pattern.panel(sewn.pattern.seams[s].b.panel).name;
    if (longer < 0.0) std::swap(a, b);
    flags.push_back("where " + a + " is sewn to " + b + " it is " +
                    std::to_string(std::lround(std::abs(longer) * kMmPerMetre)) +
                    " mm too long: ease or trim it there");
  }
  return flags;
}

}  // namespace toile
