// SPDX-License-Identifier: GPL-3.0-or-later
// Random input for single stages: what the stages before them would hardly ever hand over.
#pragma once

#include "engine/alter/alter_pattern.h"
#include "tests/stress/stress_scene.h"
#include "tests/support/dice.h"

namespace toile::stress {

// All throw what the stages throw.
void run_body_scene(test::Dice& dice, Outcome& outcome);    // files of bodies, broken and hostile
void run_cut_scene(test::Dice& dice, Outcome& outcome);     // target patterns the derivation never made, altered
void run_derive_scene(test::Dice& dice, Outcome& outcome);  // drapes that are crumpled, torn or turned over

// Original + inserted - removed = target, by areas worked out again, but for what stretched cloth makes up for.
void check_balance(const AlterPatternResult& altered, double stretch_limit, Outcome& outcome);

}  // namespace toile::stress
