// SPDX-License-Identifier: GPL-3.0-or-later
// Records as JSON text.
#pragma once

#include "engine/core/record.h"
#include "engine/core/types.h"

namespace toile {

// UTF-8 JSON, fields in their order, indented by one space a level, ending in a newline. Doubles are written with the
// fewest digits that read back exactly; a value that is not finite becomes null.
Bytes write_json(const Record& record);

}  // namespace toile
