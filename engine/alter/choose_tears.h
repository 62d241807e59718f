// SPDX-License-Identifier: GPL-3.0-or-later
// Choose which candidate tears to carry out this round, by a 0/1 program over the whole garment.
//
// Unknown: a 0/1 variable per candidate (b_i edge tears, c_i corner tears).  Maximise  sum w b + gamma sum w c  such
// that
//   every side is cut into at most Theta times over the whole run (Eq. 3)
//   what opens one ply of a seam opens the other ply at the same place (Eq. 4), or pays for not doing so
//   one tear per panel and round (Sec. 6.2)
// Sides that meet in a corner (Eq. 5) may both be released, one round after the other: forbidding it makes the program
// cut across the middle of panels instead, which no tailor does. The second pays for the corner, and the L between them
// is cut into strips (see recut) unless L-shapes are wanted. Source: [Eggler2024, Sec. 6.2, Eq. 2-5], gaps closed as in
// method.md section 5.
#pragma once

#include "engine/alter/tear_candidates.h"

namespace toile {

struct ChooseTearsOptions {
  double seam_preference = 1.5;  // gamma, >= 1: favours tears along existing seams
  int max_tears_per_side = 1;    // Theta, >= 0
  bool l_shapes = false;         // a side whose neighbour is released already costs no more than another
  double least_release = 0.03;   // share of the first energy below which a tear is only made for its partner's sake
  double least_corner_distance = 0.05;  // m: shorter sides do not have both neighbours released
  bool greedy = false;                  // no program: the best candidate of each panel, for comparison
};

// What earlier rounds did to one panel.
struct PanelTears {
  std::vector<bool> released;     // per side
  std::vector<int> edge_tears;    // per side
  std::vector<TearMouth> mouths;  // open places on the outline
};

// Where a mouth of one panel lies on other plies.
struct PartnerPlace {
  int panel = -1;
  std::vector<TearMouth> places;  // the same vertex as seen by each side it belongs to
};
std::vector<PartnerPlace> partner_places(const std::vector<Sheet>& sheets,
                                         const std::vector<std::vector<SeamPartner>>& partners, int panel,
                                         const TearMouth& mouth);

// Whether one of `mouths` lies at one of `places`, within 2 cm or two edge lengths.
bool opens_at(const Sheet& sheet, const std::vector<TearMouth>& mouths, const std::vector<TearMouth>& places);

struct ChosenTears {
  std::vector<std::size_t> candidates;  // indices, ascending
  double value = 0.0;
};

// Marks in `candidates[i].refused` what the rules of the run forbid, then chooses among the others.
ChosenTears choose_tears(std::vector<TearCandidate>& candidates, const std::vector<Sheet>& sheets,
                         const std::vector<PanelTears>& done, const std::vector<std::vector<SeamPartner>>& partners,
                         const ChooseTearsOptions& options);

}  // namespace toile
