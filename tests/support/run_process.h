// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a program as a user would and says how it went.
#pragma once

#include <string>
#include <vector>

namespace toile::test {

struct ProcessResult {
  int exit_code = -1;  // -1: ended by a signal
  std::string out, err;
  double cpu_s = 0.0;    // of the processor, user and system
  double peak_mb = 0.0;  // resident
};

// arguments[0] is the program's path. Standard input is empty.
ProcessResult run_process(const std::vector<std::string>& arguments);

// A folder of its own under the system's temporary folder, removed with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }
  // Writes a file there and returns its path.
  std::string write(const std::string& name, const std::string& content) const;

 private:
  std::string path_;
};

}  // namespace toile::test
