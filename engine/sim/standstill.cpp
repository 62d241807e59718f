// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/standstill.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

constexpr double kResidualShare = 0.5, kEnergyShare = 0.01;

}  // namespace

bool Standstill::after_round(double residual, double energy) {
  residual_.push_back(residual_.empty() ? residual : std::min(residual, residual_.back()));
  energy_.push_back(energy_.empty() ? energy : std::min(energy, energy_.back()));
  if (residual_.size() <= kRounds || residual <= kFar) return false;
  const double residual_then = residual_[residual_.size() - 1 - kRounds];
  const double energy_then = energy_[energy_.size() - 1 - kRounds];
  return residual_.back() > kResidualShare * residual_then &&
         energy_.back() > energy_then - kEnergyShare * std::abs(energy_then);
}

}  // namespace toile
