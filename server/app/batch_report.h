// SPDX-License-Identifier: GPL-3.0-or-later
// What a batch came to, on one page and as a table: bodies x zones, the worst cases first.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace toile::app {

struct BatchRow {
  std::string body;
  std::string folder;                 // of its files, relative to the report
  std::string error;                  // empty: done
  std::map<std::string, double> fit;  // zone -> stretch left, signed, dimensionless
};

// Columns: body, status, error, then every zone in percent.
std::string batch_csv(const std::vector<BatchRow>& rows);
// One self-contained page, rows sorted by their worst zone, failures first.
std::string batch_html(const std::string& garment, const std::vector<BatchRow>& rows);

}  // namespace toile::app
