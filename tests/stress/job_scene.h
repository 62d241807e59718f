// SPDX-License-Identifier: GPL-3.0-or-later
// Whole jobs on random scenes, and what must hold on their results.
#pragma once

#include "engine/pipeline.h"
#include "tests/stress/stress_scene.h"
#include "tests/support/dice.h"

namespace toile::stress {

struct JobScene {
  Pattern pattern;  // the garment, before it is written to bytes
  BodyInput reference, target;
  AlterOptions options;
  bool tight = false;      // positions are not soft: what invariance asks for can be compared closely
  bool shiftable = false;  // forms: the whole scene may be moved sideways
};

test::Dice dice_of(std::uint64_t seed);  // of the scene with this seed
JobScene patchwork_scene(test::Dice& dice, Outcome& outcome);
JobScene person_scene(test::Dice& dice, Outcome& outcome);

// A body as an OBJ file of kind Form, in the given unit.
BodyInput form_input(const TriangleMesh& surface, double metre_per_unit);

// Runs the job and every check. Throws what the job throws.
void check_job(const JobScene& scene, test::Dice& dice, Outcome& outcome);

}  // namespace toile::stress
