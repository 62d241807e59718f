// SPDX-License-Identifier: GPL-3.0-or-later
// The one error that crosses a stage boundary.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace toile {

// Closed and append-only: the names are part of the contract (problem+json `code`, result.json, exit codes).
enum class ErrorCode {
  BadUsage,            // the command line or request itself
  FileUnreadable,      // not there, no permission
  FormatUnknown,       // none of the formats Toile reads
  FileMalformed,       // broken syntax, truncated, NaN, index out of range
  LimitExceeded,       // larger than the documented limits
  OptionInvalid,       // an option outside its range, unknown name
  BodyUnusable,        // no usable surface, size outside 0.5-2.5 m
  BodyNotRecognised,   // not one upright person in A- or T-pose
  GarmentInvalid,      // outline crosses itself, degenerate panel
  SeamInvalid,         // unknown edge, edge sewn twice
  RegistrationFailed,  // guards of the body map refused
  DrapeFailed,         // no acceptable drape after the whole retry ladder
  DerivationFailed,    // no valid target pattern
  AlterationFailed,    // no valid set of operations
  Cancelled,           // asked for by the user
  TimedOut,            // wall or CPU limit
  ResourceLimit,       // memory limit
  StorageFull,         // disk
  StorageFailed,       // database or artifact store
  Crashed,             // the job's process ended by a signal
  NotFound,            // no such resource
  Conflict,            // state does not allow it
  Unauthorized,        // missing or wrong API key
  QueueFull,           // too much waiting work
  Internal,            // a bug in Toile
};

// Stable snake_case name, e.g. "file_malformed".
std::string_view error_name(ErrorCode code);

// Exit code of the command line: 2 usage, 3 bad input, 4 classified failure, 5 cancelled, 70 internal.
int exit_code(ErrorCode code);

struct Error : std::exception {
  ErrorCode code;
  std::string subject;  // the thing: "panel:front_left", "seam:12", "body", "options/triangles", a JSON pointer
  std::string message;  // what, where, and what would mend it

  Error(ErrorCode code_, std::string subject_, std::string message_);
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

}  // namespace toile
