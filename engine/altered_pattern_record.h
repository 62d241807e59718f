// SPDX-License-Identifier: GPL-3.0-or-later
// What altered_pattern.json says beside the pattern itself: where its pieces come from, what its seams join, what is
// taken away (schemas/altered_pattern.schema.json).
#pragma once

#include "engine/alter/alter_pattern.h"
#include "engine/core/record.h"

namespace toile {

// Lengths in mm and areas in cm2, as the names say. Outlines are in the frame of the original panel.
Record altered_pattern_record(const AlterPatternResult& altered);

}  // namespace toile
