// SPDX-License-Identifier: GPL-3.0-or-later
// What a finished job hands over: named files as bytes. The same job gives the same bytes; clocks stand in timings.json
// alone. Only what the option `outputs` asks for is made.
#pragma once

#include "engine/output_file.h"
#include "engine/pipeline.h"

namespace toile {

// What documents say of an input.
struct InputInfo {
  std::string role, name;
  std::string sha256;  // of its bytes; empty for a built-in body
};

struct JobInfo {
  InputInfo garment;
  std::vector<InputInfo> bodies;
};
JobInfo job_info(const GarmentInput& garment, const BodyInput& body);
JobInfo job_info(const GarmentInput& garment, const BodyInput& reference_body, const BodyInput& target_body);

enum class JobWork { Alter, Drape };

// That the job makes every file the option `outputs` names. Throws Error{OptionInvalid, "/outputs/INDEX"} that says
// which it makes.
void check_outputs(const AlterOptions& options, JobWork work);

// `at_once`: pictures are drawn by two threads.
std::vector<OutputFile> alter_outputs(const AlterResult& result, const AlterOptions& options, const JobInfo& info,
                                      bool at_once = false);
std::vector<OutputFile> drape_outputs(const DrapedGarment& result, const AlterOptions& options, const JobInfo& info);

// timings.json: CPU and wall seconds of every stage, and which were read back.
OutputFile timings_output(const std::vector<StageTiming>& timings);

}  // namespace toile
