// SPDX-License-Identifier: GPL-3.0-or-later
// Random input for single stages: what the stages before them would hardly ever hand over.
#pragma once

#include "tests/stress/stress_scene.h"
#include "tests/support/dice.h"

namespace toile::stress {

// All throw what the stages throw.
void run_body_scene(test::Dice& dice, Outcome& outcome);    // files of bodies, broken and hostile
void run_cut_scene(test::Dice& dice, Outcome& outcome);     // target patterns the derivation never made, altered
void run_derive_scene(test::Dice& dice, Outcome& outcome);  // drapes that are crumpled, torn or turned over

}  // namespace toile::stress
