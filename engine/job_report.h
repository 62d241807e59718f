// SPDX-License-Identifier: GPL-3.0-or-later
// What report.html says of an alteration in sentences and tables (design: service contract, section 1).
#pragma once

#include <optional>

#include "engine/io/html_page.h"
#include "engine/pipeline.h"

namespace toile {

// Fits of a job against the fit on the reference body.
struct JobFits {
  std::optional<FitComparison> before;  // the garment as it was, where an output needs that
  FitComparison ideal;                  // as the target pattern has it
  std::optional<FitComparison> after;   // as altered, where that could be sewn and draped
};
JobFits compare_job_fits(const AlterResult& result);

// How the job may be called: "Skirt pencil" for "skirt_pencil_specification.json"; names given by people stay.
std::string readable_garment_name(const std::string& name);

// What was done and what came of it, with everything that the reader must know before cutting.
std::vector<std::string> summary_sentences(const AlterResult& result, const JobFits& fits);
// The tables, like the sentences, require `before`.
HtmlTable zone_table(const JobFits& fits);
HtmlTable drape_quality_table(const AlterResult& result);

}  // namespace toile
