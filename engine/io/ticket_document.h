// SPDX-License-Identifier: GPL-3.0-or-later
// The tailor's work order as documents: the record behind ticket.json (schemas/ticket.schema.json) and ticket.html.
#pragma once

#include "engine/core/record.h"
#include "engine/core/ticket.h"
#include "engine/io/html_page.h"

namespace toile {

// Lengths in mm to 0.1, areas in cm2 to 0.1, angles in degrees to 0.1; `order` counts the operations from 1.
Record ticket_record(const Ticket& ticket);

// What to do, step by step, with boxes to tick; pieces to cut; notes. For a page of its own or inside the report.
void add_ticket(const Ticket& ticket, HtmlPage& page);

// `pattern_svg`: an inlined drawing (svg.h) shown after the steps, or empty. `date` as it is to be printed, or empty.
Bytes write_ticket_html(const Ticket& ticket, const Bytes& pattern_svg = {}, std::string_view date = {});

}  // namespace toile
