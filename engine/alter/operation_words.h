// SPDX-License-Identifier: GPL-3.0-or-later
// Sides and operations in the words of the person who sews. Used by read_operations only.
#pragma once

#include "engine/alter/sheet.h"
#include "engine/core/ticket.h"

namespace toile {

// What a side is called: the names the garment gives its edges, else "hem of front", "seam of front and back".
std::vector<std::string> side_names(const Pattern& pattern, const Sheet& sheet, int side);

// A side that can say where something is: "waist", "hem"; empty for seams without a name.
std::string edge_words(const Pattern& pattern, const Sheet& sheet, int side);

std::string panel_words(const Panel& panel);

// "left" and "right" taken out of a name, so that mirror images read the same: "sleeve" for "left_sleeve".
std::string without_left_right(const std::string& name);

// Names as one says them, each once, mirror images together: "left and right side, waist and hem".
std::string spoken_list(const std::vector<std::string>& names);

// Where on a side or cut something is: "at the top", "at the bottom", "in the middle".
std::string place_words(const Vec2& point, const std::vector<Vec2>& outline);

// All of an operation in one line.
std::string operation_sentence(const TicketOperation& operation);

}  // namespace toile
