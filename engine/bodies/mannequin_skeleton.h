// SPDX-License-Identifier: GPL-3.0-or-later
// The skeleton of a mannequin, read off the rows of its cage: known, not found. Same meaning as find_skeleton's.
#pragma once

#include "engine/core/body.h"

namespace toile {

// `vertices` of the mannequin template, m.
Skeleton mannequin_skeleton(const Points3& vertices);

}  // namespace toile
