// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures as PNG bytes: 8-bit RGB, no time stamp, so equal pictures give equal bytes.
#pragma once

#include "engine/render/image.h"

namespace toile {

// Throws Error{Internal} if the picture is empty.
Bytes write_png(const Image& image);

}  // namespace toile
