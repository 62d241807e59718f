// SPDX-License-Identifier: GPL-3.0-or-later
// Sides and operations in the words of the person who sews. Used by read_operations only.
#pragma once

#include "engine/alter/sheet.h"
#include "engine/core/ticket.h"

namespace toile {

// "hem of front", "seam of front and back", or the edge's own name where the garment gives one.
std::string side_words(const Pattern& pattern, const Sheet& sheet, int side);

// "left" and "right" taken out of a name, so that mirror images read the same: "sleeve" for "left_sleeve".
std::string without_left_right(const std::string& name);

// Where on a side or cut something is: "at the top", "at the bottom", "in the middle".
std::string place_words(const Vec2& point, const std::vector<Vec2>& outline);

// All of an operation in one line.
std::string operation_sentence(const TicketOperation& operation);

}  // namespace toile
