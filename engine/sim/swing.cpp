// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/swing.h"

#include <cmath>
#include <limits>

namespace toile {

double Swing::after_round(const Points3& nodes) {
  const double before = move_;
  move_ = std::sqrt((nodes - last_).rowwise().squaredNorm().mean());
  last_ = nodes;
  return move_ < before ? move_ * move_ / (before - move_) : std::numeric_limits<double>::infinity();
}

}  // namespace toile
