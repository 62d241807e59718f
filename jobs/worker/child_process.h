// SPDX-License-Identifier: GPL-3.0-or-later
// One process with limits, that dies with its parent, talked to by lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace toile {

struct ChildLimits {
  std::int64_t memory_bytes = 4LL << 30;  // address space; 0: none
  int cpu_s = 3600;                       // processor seconds; 0: none
  std::int64_t file_bytes = 1LL << 30;    // size of one file it writes; 0: none
};

struct ChildEnd {
  int signal = 0;  // 0: it exited
  int exit_code = 0;
  double cpu_s = 0.0;
  std::int64_t peak_memory_bytes = 0;
};

class ChildProcess {
 public:
  // Runs `command` in `folder`; its standard error goes to `folder`/stderr.txt. Call it from a thread that outlives the
  // child: the child is killed when that thread ends. Throws Error{ResourceLimit} when no process can be made.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& folder, const ChildLimits& limits);
  // Kills and reaps a child still running.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Writes to its standard input; false when it is gone.
  bool send_line(const std::string& line);
  // Waits up to `timeout` for output and appends complete lines to `lines`. False once the output has ended, or a line
  // grew beyond all bounds.
  bool read_lines(std::vector<std::string>& lines, std::chrono::milliseconds timeout);

  void ask_to_end();  // SIGTERM
  void kill();        // SIGKILL to it and all its children
  ChildEnd wait();

 private:
  int process_ = -1;
  int input_ = -1;
  int events_ = -1;
  std::string partial_;
};

}  // namespace toile
