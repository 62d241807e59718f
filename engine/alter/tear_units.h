// SPDX-License-Identifier: GPL-3.0-or-later
// What a tailor might open: sides let go along their seams and cuts through the cloth, and which of them are one job.
//
// One job is: both plies of a seam, its mirror image on the wearer, and its continuation across the seams it meets (a
// hem runs on round the garment, a waist seam round the waist); of cuts, those that continue each other across seams.
// Source: [Eggler2024, Sec. 6.1 "Seam consistency", Sec. 6.2, Fig. 9].  Lengths in metres.
#pragma once

#include "engine/alter/panel_twins.h"
#include "engine/alter/propagate_tear.h"

namespace toile {

struct TearUnit {
  std::vector<Tear> tears;  // in one panel; two where the panel is its own mirror image
  int job = -1;
  double burden =
      0.0;  // what it costs beside its job, in jobs: a curved side is harder to sew on to than a straight one
};

struct TearUnits {
  std::vector<std::vector<TearUnit>> of_panel;  // empty where another panel chooses
  std::vector<int> chooser;                     // per panel: itself, or the twin that chooses for it
  std::vector<double> job_cost;                 // a seam 1, a cut as much as the preference for seams says
  std::vector<std::vector<int>> side_jobs;      // per panel and side: the job of letting it go, -1 where locked
};

// Lets go of sides; `symmetric`: twins choose together.
TearUnits side_units(const Pattern& pattern, const std::vector<Sheet>& sheets,
                     const std::vector<std::vector<SeamPartner>>& partners,
                     const std::vector<std::optional<PanelTwin>>& twins);

struct CutUnitOptions {
  int max_tears_per_side = 1;    // Theta
  double seam_preference = 1.5;  // gamma
  double least_cut_side = 0.06;  // m: shorter sides are not cut into
  TearOptions tear;
};

// Adds cuts from the middle of every side of `panels`, and what continues them through other panels.
void add_cut_units(const Pattern& pattern, const std::vector<Sheet>& sheets,
                   const std::vector<std::vector<SeamPartner>>& partners,
                   const std::vector<std::optional<PanelTwin>>& twins, const std::vector<int>& panels,
                   const CutUnitOptions& options, TearUnits& units);

// The same tear on the mirror image of its panel.
Tear mirrored(const Tear& tear, const PanelTwin& twin, const Sheet& from, const Sheet& to);

}  // namespace toile
