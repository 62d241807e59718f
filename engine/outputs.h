// SPDX-License-Identifier: GPL-3.0-or-later
// What a finished job hands over: named files as bytes. The same job gives the same bytes; clocks stand in timings.json
// alone. Only what the option `outputs` asks for is made.
#pragma once

#include "engine/pipeline.h"

namespace toile {

struct OutputFile {
  std::string name;
  std::string content_type;
  Bytes bytes;
};

// The names of the inputs and the date that documents carry; a job's, never the clock's.
struct JobInfo {
  std::string garment, reference_body, target_body;
  std::string garment_sha256, reference_body_sha256, target_body_sha256;
};

std::vector<OutputFile> alter_outputs(const AlterResult& result, const AlterOptions& options, const JobInfo& info);
std::vector<OutputFile> drape_outputs(const DrapedGarment& result, const AlterOptions& options, const JobInfo& info);

// timings.json: CPU and wall seconds of every stage, and which were read back.
OutputFile timings_output(const std::vector<StageTiming>& timings);

}  // namespace toile
