// SPDX-License-Identifier: GPL-3.0-or-later
// What a batch came to, on one page and as a table: bodies x zones, the worst cases first.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace toile::http {

enum class BatchRowStatus { Done, Failed, Cancelled, Queued, Running };

struct BatchRow {
  std::string body;   // file or name
  std::string id;     // of the stored body; empty where bodies are files
  std::string link;   // to its results, relative to the report; empty: none yet
  BatchRowStatus status = BatchRowStatus::Done;
  std::string error;                  // why it failed
  std::map<std::string, double> fit;  // zone -> stretch left, signed, dimensionless
};

// Columns: body, the id where there is one, status, error, then every zone in percent.
std::string batch_csv(const std::vector<BatchRow>& rows);
// One self-contained page, rows sorted by their worst zone, failures first, unfinished ones last.
std::string batch_html(const std::string& garment, const std::vector<BatchRow>& rows);

}  // namespace toile::http
