// SPDX-License-Identifier: GPL-3.0-or-later
// Turn a garment file into a pattern that every later stage may rely on.
//
// Reads a GarmentCode specification (JSON, with or without the `toile` block) and proves: outlines closed, free of
// self-crossings and not degenerate; every stitched edge exists and is sewn once; panel and edge sizes within human
// garments. Source: the format as documented by GarmentCode's loader. Lengths in metres.
#pragma once

#include <span>

#include "engine/core/pattern.h"
#include "engine/core/progress.h"

namespace toile {

// Ensures the guarantees above. Throws Error{FileMalformed, LimitExceeded, GarmentInvalid, SeamInvalid}; the subject is
// the JSON pointer of the offending value, the message names panel and edge and says what would mend it.
Pattern import_pattern(std::span<const std::uint8_t> bytes, Progress* progress = nullptr);

// The geometric and seam checks alone, for patterns that do not come from a file. Subjects are the JSON pointers that
// the pattern has when written as a GarmentCode specification.
void validate_pattern(const Pattern& pattern);

}  // namespace toile
