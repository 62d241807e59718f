// SPDX-License-Identifier: GPL-3.0-or-later
// report.html: everything a shop wants to see of a job on one page that can be mailed and printed.
#pragma once

#include "engine/core/record.h"
#include "engine/core/ticket.h"
#include "engine/io/html_page.h"

namespace toile {

struct ReportPicture {
  Bytes png;
  std::string caption;
};

struct Report {
  std::string title, subtitle;
  std::vector<std::string> summary;     // a few sentences at the top: what was asked, what came out
  std::vector<ReportPicture> fits;      // reference, before, after; one scale
  std::vector<HtmlTable> zones;         // numbers per zone
  const Ticket* ticket = nullptr;       // may be null
  Bytes pattern_svg;                    // inlined drawing (svg.h with `inlined`), or empty
  std::vector<ReportPicture> pictures;  // further ones: flat pattern, steps of tears
  std::vector<HtmlTable> quality;       // how far the simulation is to be trusted
  std::vector<std::string> findings;    // what did not come out as it should
  Record measurements, options;
};

// Sections without content are left out.
Bytes write_report_html(const Report& report);

}  // namespace toile
