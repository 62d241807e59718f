// SPDX-License-Identifier: GPL-3.0-or-later
// How a pass tore its panels, step by step: the stretched cloth before any tear, then after every round. Made anew from
// the tears that a finished alteration tells of, since it keeps no cloth between them.
// Source: [Eggler2024, Sec. 6.3, Fig. 12].  Lengths in metres.
#pragma once

#include "engine/alter/alter_pattern.h"

namespace toile {

struct TearStep {
  int panel = 0;
  bool removing = false;        // the cloth is the target's, and what opens is taken from the original
  std::vector<MadeTear> tears;  // new in this step; empty: the stretched cloth before any
  Sheet sheet;                  // where the cloth lies after it
  SheetStress stress;           // what is left in it
};

// Of one pass, the steps of a panel in their order; panels that were not torn have none. The last step of a panel is
// its cloth before the plies of its seams are brought together.
std::vector<TearStep> tear_steps(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const AlterPatternResult& altered, const AlterPatternOptions& options, bool removing);

}  // namespace toile
