// SPDX-License-Identifier: GPL-3.0-or-later
// Tells cloth that will not come to rest: layers tangled beyond mending, or a fabric far too stiff for its mesh, keep
// forces hundreds of times the cloth's weight however long one iterates. Watched round after round. The energy of
// tangled cloth tells nothing: it falls while layers pass through each other.
#pragma once

#include <vector>

namespace toile {

class Standstill {
 public:
  // `residual` (DrapeEnergy::residual), `energy` (J) and `tangle` (ClothContact::tangle) at the end of a round. True
  // when the forces are far from rest and in the last kRounds rounds either neither the least residual has halved nor
  // the least energy has fallen by a hundredth, or the cloth was tangled and has not come half free.
  bool after_round(double residual, double energy, double tangle = 0.0);
  // Whether the cloth was tangled in the last kRounds rounds and has not come half free.
  bool tangled() const { return tangled_rounds_ > kRounds; }

  static constexpr int kRounds = 10;
  static constexpr double kFar = 100.0;  // garments that come to rest are below it within 250 iterations

 private:
  bool gets_nowhere() const;
  void watch_tangle(double tangle);

  std::vector<double> residual_, energy_;  // least so far, per round
  double tangle_ = 0.0;                    // at the first of the tangled rounds
  int tangled_rounds_ = 0;                 // without a break, in which the tangle has not halved
};

}  // namespace toile
