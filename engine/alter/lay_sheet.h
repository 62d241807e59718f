// SPDX-License-Identifier: GPL-3.0-or-later
// A start for the relaxation of one mesh of a panel from another one that is relaxed already.
#pragma once

#include "engine/alter/sheet.h"

namespace toile {

// Moves sheet.now as far from the plain map as the cloth of `relaxed`, the same panel on another mesh, has moved there.
void lay_like(Sheet& sheet, const Sheet& relaxed);

}  // namespace toile
