// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/standstill.h"

#include <algorithm>
#include <cmath>

#include "engine/sim/cloth_contact.h"

namespace toile {
namespace {

constexpr double kResidualShare = 0.5, kEnergyShare = 0.01, kTangleShare = 0.5;

}  // namespace

bool Standstill::after_round(double residual, double energy, double tangle) {
  residual_.push_back(residual_.empty() ? residual : std::min(residual, residual_.back()));
  energy_.push_back(energy_.empty() ? energy : std::min(energy, energy_.back()));
  watch_tangle(tangle);
  return residual > kFar && (tangled() || gets_nowhere());
}

void Standstill::watch_tangle(double tangle) {
  if (tangled_rounds_ == 0 || tangle < kTangleShare * tangle_) tangle_ = tangle, tangled_rounds_ = 0;
  tangled_rounds_ = tangle > ClothContact::kTangled ? tangled_rounds_ + 1 : 0;
}

bool Standstill::gets_nowhere() const {
  if (residual_.size() <= kRounds) return false;
  const double residual_then = residual_[residual_.size() - 1 - kRounds];
  const double energy_then = energy_[energy_.size() - 1 - kRounds];
  return residual_.back() > kResidualShare * residual_then &&
         energy_.back() > energy_then - kEnergyShare * std::abs(energy_then);
}

}  // namespace toile
