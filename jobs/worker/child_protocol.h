// SPDX-License-Identifier: GPL-3.0-or-later
// The talk between a worker and the child process that runs one job: JSON, one message a line. The child reads its
// request and replies from standard input and writes to kEventDescriptor. Files are named relative to the scratch
// folder.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "jobs/store/job.h"

namespace toile {

inline constexpr int kEventDescriptor = 3;
inline constexpr std::size_t kMaxMessageBytes = 8 << 20;  // a longer line is a broken child

struct InputFile {
  std::string file;  // absolute
  std::string name;
  std::string fields;
};

struct JobRequest {
  std::string kind;
  std::string options;
  std::int64_t created_ms = 0;
  int threads = 1;
  std::map<std::string, InputFile> inputs;
};

struct ChildEvent {
  enum class Kind { Progress, FindStage, KeepStage, Artifact, Done, Failed } kind = Kind::Progress;
  std::string name;              // stage of Progress; key of FindStage, KeepStage; name of Artifact
  double fraction = 0.0;         // Progress
  std::string file;              // KeepStage, Artifact
  std::string content_type;      // Artifact
  std::string summary, timings;  // Done
  JobError error;                // Failed
};

std::string encode_request(const JobRequest& request);
JobRequest decode_request(const std::string& line);

std::string encode_event(const ChildEvent& event);
// Nothing for a line that is no event: the sender may be damaged.
std::optional<ChildEvent> decode_event(const std::string& line);

// The answer to FindStage: a file to read, or none.
std::string encode_stage_reply(const std::optional<std::string>& file);
std::optional<std::string> decode_stage_reply(const std::string& line);

// Letters, digits, '.', '_' and '-', not starting with a dot, at most 100: safe as the name of a file.
bool is_plain_name(const std::string& name);

}  // namespace toile
