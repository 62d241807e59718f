// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that ship with Toile, by the name that follows "builtin:".
#pragma once

#include <string_view>

#include "engine/core/body.h"

namespace toile {

// A mannequin ("woman-38-168", "man-50-178", "child-128": mannequin_names.h) or a form ("tube-14-100": make_form.h).
// Throws: NotFound, naming what is known.
Body make_builtin_body(std::string_view name);

}  // namespace toile
