// SPDX-License-Identifier: GPL-3.0-or-later
// What a kind of job is to the worker: a function from bytes to named artifacts. The application wires the kinds
// (`alter`, `drape`) to the engine.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "engine/core/progress.h"
#include "engine/core/stage_cache.h"

namespace toile {

struct JobInput {
  std::string name;    // as the user called it; never a path
  std::string fields;  // JSON: unit, up, landmarks, format
  Bytes bytes;
};

using ArtifactSink = std::function<void(const std::string& name, const std::string& content_type, const Bytes& bytes)>;

struct JobContext {
  std::map<std::string, JobInput> inputs;  // by role: garment, worn, reference_body, target_body
  std::string options = "{}";              // JSON, validated when the job was handed in
  std::int64_t created_ms = 0;             // dates in outputs come from here, not from the clock
  int threads = 1;
  ArtifactSink artifact;  // names: letters, digits, '.', '_', '-'; each at most once
  StageCache* stages = nullptr;
  Progress* progress = nullptr;
};

struct JobReport {
  std::string summary = "{}";  // JSON shown with the job: quality, alterations in short, fit by zone
  std::string timings = "{}";  // JSON: clocks and memory
};

// Throws toile::Error.
using JobHandler = std::function<JobReport(const JobContext&)>;
using JobHandlers = std::map<std::string, JobHandler>;

}  // namespace toile
