// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/read_operations.h"

namespace toile {

void read_operations(const Pattern&, const PatternMesh&, const TornPattern&, const TornPattern&,
                     const AlterPatternOptions&, AlterPatternResult&) {}

}  // namespace toile
