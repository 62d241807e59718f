// SPDX-License-Identifier: GPL-3.0-or-later
// One pass of the alteration: stretch every panel's cloth onto the wanted outline and tear it until what it keeps is
// within the allowed stretch. Run from the original onto the target it says where to insert; with the roles swapped,
// where to take away. Which tears is decided on a coarse copy; the garment's own mesh then carries them out.
// Source: [Eggler2024, Sec. 6, Algorithm 1].  Lengths in metres.
#pragma once

#include "engine/alter/choose_tears.h"
#include "engine/alter/tear_memory.h"

namespace toile {

struct TearPatternOptions {
  CandidateOptions candidates;
  ChooseTearsOptions choice;
  int max_rounds = 12;
  double l_price = 0.25;  // jobs, what an L costs where they are not wanted
  bool symmetric = true;  // mirror images are altered alike
  bool removing = false;  // the cloth is the target's, and what opens is taken from the original
};

// What one pass stretches onto what.
struct Stretching {
  const PatternMesh& mesh;
  const Points2 &cloth, &wanted;  // #V x 2 of the mesh
};

// One tear that was made, with why.
struct MadeTear {
  Tear tear;
  int round = 0;
  double weight = 0.0;       // in the program, before the preference for seams
  double release = 0.0;      // share of the panel's first energy
  double largest_gap = 0.0;  // m, when it was made
  bool for_partner = false;  // releases little here: made because the other ply opens there
};

struct PanelTearing {
  SheetStress before, after;
  std::vector<MadeTear> tears;
  bool done = false;      // what is left is within the stretch limit
  bool overlaps = false;  // kept cloth lies outside the wanted outline
  std::string reason;     // why not, or empty
};

struct TornPattern {
  std::vector<Sheet> sheets;  // one per panel, in the order of the pattern
  std::vector<PanelTearing> panels;
  std::vector<std::vector<int>> jobs;  // per panel and tear: tears of one number are one job for the person who sews
  int rounds = 0;
  int trials = 0;    // sets of tears that were carried out on a copy
  int reverted = 0;  // tears found redundant and undone
};

// `memory`: of the same pass with another stretch limit, or empty; grows.
TornPattern tear_pattern(const Pattern& pattern, const Stretching& fine, const Stretching& coarse,
                         const TearPatternOptions& options, TearMemory& memory, Progress* progress = nullptr);

}  // namespace toile
