// SPDX-License-Identifier: GPL-3.0-or-later
// Where a stretched sheet might be torn next, and what each tear would gain.
#pragma once

#include "engine/alter/propagate_tear.h"

namespace toile {

enum class TearWeighting {
  Release,   // energy the tear releases on a trial copy: fewest tears
  Boundary,  // tangential stress of the border where it starts [Eggler2024, Sec. 6.2, Fig. 11]: cheaper, more tears
};

// A tear with what it leads to; `after` is the sheet once it is done.
struct TearCandidate {
  Tear tear;
  double weight = 0.0;   // what the program maximises, before the preference for seams; dimensionless
  double release = 0.0;  // energy released, share of the panel's first energy
  TearOutcome outcome;
  Sheet after;
  SheetStress stress;   // of `after`
  std::string refused;  // why it may not be chosen, or empty
};

struct CandidateOptions {
  TearOptions tear;
  TearWeighting weighting = TearWeighting::Release;
  double stretch_limit = 0.03;   // mu
  double least_strip = 0.015;    // m: an edge tear that opens less is not worth a cut
  double least_cut_side = 0.06;  // m: shorter sides are not cut into
};

// Tears that may be tried on the sheet as it is: every unlocked side that is not torn off yet, and the middle of every
// unlocked side whose entry in `edge_tears` is below `theta`.
std::vector<Tear> possible_tears(const Sheet& sheet, const std::vector<int>& edge_tears, int theta,
                                 const CandidateOptions& options);

// Carries the tear out on a copy and weighs it; `first_energy` is the panel's before any tear.
TearCandidate try_tear(const Sheet& sheet, const Tear& tear, const SheetStress& before, double first_energy,
                       const CandidateOptions& options, Progress* progress = nullptr);

}  // namespace toile
