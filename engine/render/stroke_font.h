// SPDX-License-Identifier: GPL-3.0-or-later
// A small built-in stroke font for labels in pictures: ASCII; every other character is drawn as a question mark.
#pragma once

#include <string_view>

#include "engine/core/types.h"

namespace toile {

// The strokes of a text whose baseline starts at (0, 0): x to the right, y up, capitals `height` tall. A stroke of two
// equal points is a dot. UTF-8 sequences count as one character.
std::vector<std::vector<Vec2>> text_strokes(std::string_view text, double height);

// Width of the drawn text.
double text_width(std::string_view text, double height);

}  // namespace toile
