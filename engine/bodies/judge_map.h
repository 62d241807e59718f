// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that tell whether a mapped reference body really lies on the target. Source: shared design page
// "registration", section 4.
#pragma once

#include "engine/bodies/refine_map.h"
#include "engine/bodies/register_bodies.h"

namespace toile {

// Fills the report. Throws RegistrationFailed where a number is beyond what a right map can have.
RegistrationReport judge_map(const RegistrationReference& reference, const Points3& mapped, const FitTarget& target);

}  // namespace toile
