// SPDX-License-Identifier: GPL-3.0-or-later
// Tells cloth that will not come to rest: layers tangled beyond mending, or a fabric far too stiff for its mesh, keep
// forces hundreds of times the cloth's weight however long one iterates. Watched round after round.
#pragma once

#include <vector>

namespace toile {

class Standstill {
 public:
  // `residual` (DrapeEnergy::residual) and `energy` (J) at the end of a round. True when the forces are far from rest
  // and in the last kRounds rounds neither the least residual has halved nor the least energy has fallen by a
  // hundredth.
  bool after_round(double residual, double energy);

  static constexpr int kRounds = 10;
  static constexpr double kFar = 100.0;  // garments that come to rest are below it within 250 iterations

 private:
  std::vector<double> residual_, energy_;  // least so far, per round
};

}  // namespace toile
