// SPDX-License-Identifier: GPL-3.0-or-later
// Choose one set of tears per panel by a 0/1 program over the whole garment: as few jobs as bring every panel within
// the allowed stretch.
//
// Unknown: z_pS, panel p takes set S; y_k, job k is done.  Minimise
//   sum_k cost_k y_k  +  sum z_pS (burden_S + prices of the stretch and the lean it leaves)  +  sum_m slack_m
// such that
//   every panel takes one set;  z_pS <= y_k for the jobs k of S
//   sides are cut into at most Theta times, by S itself (Eq. 3)
//   what opens one ply of a seam opens the other ply at the same place (Eq. 4), or pays for not doing so
//   neighbouring sides let go leave an L (Eq. 5), which costs unless L-shapes are wanted
//   no more jobs are done than without a price of lean: among equal work cloth that hangs straight
// The preference for seams, gamma, is what a cut costs beside a seam (Eq. 2).
// Source: [Eggler2024, Sec. 6.2, Eq. 2-5]; that all tears of a panel are chosen together, every set relaxed for itself,
// and jobs rather than tears are counted is this project's.
#pragma once

#include "engine/alter/choose_tears.h"
#include "engine/alter/search_tears.h"

namespace toile {

struct ChooseSetsOptions {
  double stretch_limit = 0.03;  // mu
  bool l_shapes = false;
  double excess_price = 2.0;   // jobs, of twice the allowed stretch
  double near_enough = 1.1;    // times the allowed stretch; what leaves more is not done ...
  double undone_price = 1.5;   // ... and costs so much, in jobs
  double lean_price = 0.3;     // jobs, of cloth that leans as far as mean strain may move its edges
  double open_price = 0.12;    // jobs, of a place where only one ply opens
  double corner_price = 0.01;  // jobs, of an L where two pieces of cloth meet; where more meet, by the square
};

// Index of the chosen set per panel; 0 where another panel chooses. `value`: the cost, in jobs.
struct ChosenSets {
  std::vector<std::size_t> set_of_panel;
  double value = 0.0;
};

ChosenSets choose_sets(const std::vector<std::vector<TearSet>>& sets, const TearUnits& units,
                       const std::vector<Sheet>& sheets, const std::vector<std::vector<SeamPartner>>& partners,
                       const std::vector<std::optional<PanelTwin>>& twins, const ChooseSetsOptions& options);

// What a set costs beside its jobs, in jobs. `plies`: per side, how many pieces of cloth meet where it ends.
double set_burden(const TearSet& set, const std::vector<TearUnit>& units, const std::vector<int>& plies,
                  const ChooseSetsOptions& options);

}  // namespace toile
