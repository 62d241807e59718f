// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/inspection.h"

#include <chrono>

#include "jobs/store/identifier.h"

namespace toile {

namespace {

namespace fs = std::filesystem;
using Steady = std::chrono::steady_clock;

struct Folder {
  fs::path path;
  explicit Folder(const fs::path& root) : path(root / random_identifier("inspect")) { fs::create_directory(path); }
  ~Folder() {
    std::error_code error;
    fs::remove_all(path, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

ErrorCode code_of(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(ErrorCode::Internal); ++i)
    if (error_name(static_cast<ErrorCode>(i)) == name) return static_cast<ErrorCode>(i);
  return ErrorCode::Internal;
}

std::optional<ChildEvent> last_word(ChildProcess& child, int wall_s) {
  const auto until = Steady::now() + std::chrono::seconds(wall_s);
  std::optional<ChildEvent> result;
  std::vector<std::string> lines;
  for (bool open = true; open;) {
    lines.clear();
    open = child.read_lines(lines, std::chrono::milliseconds(50));
    for (const std::string& line : lines) {
      const auto event = decode_event(line);
      if (event && (event->kind == ChildEvent::Kind::Done || event->kind == ChildEvent::Kind::Failed)) result = event;
    }
    if (Steady::now() > until)
      throw Error(ErrorCode::LimitExceeded, "file", "reading the file takes too long: simplify it");
  }
  return result;
}

}  // namespace

std::string inspect_in_child(Store& store, const JobRequest& request, const AttemptOptions& options) {
  const Folder folder(store.scratch_folder());
  ChildProcess child(options.command, folder.path, options.limits);
  child.send_line(encode_request(request));
  const std::optional<ChildEvent> result = last_word(child, options.wall_s);
  child.wait();
  if (!result)
    throw Error(ErrorCode::FileMalformed, "file", "the file makes its reader fail: save it again with another program");
  if (result->kind == ChildEvent::Kind::Failed) {
    const ErrorCode code = code_of(result->error.code);
    throw Error(code == ErrorCode::ResourceLimit ? ErrorCode::LimitExceeded : code, result->error.subject,
                result->error.message);
  }
  return result->summary;
}

}  // namespace toile
