// SPDX-License-Identifier: GPL-3.0-or-later
// A disk for SQLite that remembers what was flushed and what was only written, so that a test can cut its power: after
// the cut every file holds what was flushed, and of each later write all, nothing, or some of its sectors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace toile::test {

// One file: its flushed content and the writes after the last flush, oldest first.
struct RecordedFile {
  struct Change {
    std::int64_t offset = 0;
    std::string bytes;
    bool truncate = false;  // to `offset` bytes
  };
  bool exists = false;
  std::string flushed;
  std::vector<Change> pending;
};

class RecordingDisk {
 public:
  using Files = std::map<std::string, RecordedFile>;  // by file name without folder

  // Becomes SQLite's default disk until destroyed; one at a time. Files go to the real disk as well. `on_change` is
  // called after each write, truncation and flush.
  explicit RecordingDisk(std::function<void()> on_change);
  ~RecordingDisk();
  RecordingDisk(const RecordingDisk&) = delete;
  RecordingDisk& operator=(const RecordingDisk&) = delete;

  const Files& files() const;

  // What the files hold after a power cut, written into `folder`.
  static void write_after_cut(const Files& files, std::mt19937& random, const std::filesystem::path& folder);
};

}  // namespace toile::test
