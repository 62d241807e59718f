// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/core/error.h"
#include "jobs/worker/child_protocol.h"

namespace toile {

namespace {

constexpr int kOpenFiles = 256;
constexpr int kExecFailed = 127;

// Descriptors the child will dup2 must lie above those it dup2s onto.
int above_standard(int descriptor) {
  const int high = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 10);
  ::close(descriptor);
  return high;
}

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw Error(ErrorCode::ResourceLimit, "worker", "no more descriptors: raise the limit of open files");
    read = above_standard(ends[0]);
    write = above_standard(ends[1]);
  }
};

void limit(int resource, std::int64_t soft, std::int64_t hard) {
  const struct rlimit value = {static_cast<rlim_t>(soft), static_cast<rlim_t>(hard)};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

// Between fork and exec: only calls that are safe in a process with several threads.
[[noreturn]] void become(char* const* arguments, const char* folder, const ChildLimits& limits, int input, int events,
                         int null, int errors, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kExecFailed);  // the parent died before the line above
  ::setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (::chdir(folder) != 0) ::_exit(kExecFailed);
  ::dup2(input, STDIN_FILENO);
  ::dup2(null, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::dup2(events, kEventDescriptor);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_NOFILE, kOpenFiles, kOpenFiles);
  if (limits.cpu_s > 0) limit(RLIMIT_CPU, limits.cpu_s, limits.cpu_s + 2);
  if (limits.file_bytes > 0) limit(RLIMIT_FSIZE, limits.file_bytes, limits.file_bytes);
#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer reserves terabytes of address space
  if (limits.memory_bytes > 0) limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
#endif
  ::execv(arguments[0], arguments);
  ::_exit(kExecFailed);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& folder,
                           const ChildLimits& limits) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::string error_file = (folder / "stderr.txt").string();
  const int null = above_standard(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  const int errors = above_standard(::open(error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  const Pipe input, events;
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(arguments.data(), folder.c_str(), limits, input.read, events.write, null, errors, parent);
  for (const int descriptor : {null, errors, input.read, events.write})
    if (descriptor >= 0) ::close(descriptor);
  input_ = input.write;
  events_ = events.read;
  if (process_ < 0) {
    ::close(input_);
    ::close(events_);
    throw Error(ErrorCode::ResourceLimit, "worker", std::string("cannot start a process: ") + std::strerror(errno));
  }
  ::setpgid(process_, process_);
  ::fcntl(events_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    kill();
    wait();
  }
  ::close(input_);
  ::close(events_);
}

bool ChildProcess::send_line(const std::string& line) {
  const std::string text = line + "\n";
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t count = ::write(input_, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool ChildProcess::read_lines(std::vector<std::string>& lines, std::chrono::milliseconds timeout) {
  struct pollfd wanted = {events_, POLLIN, 0};
  if (::poll(&wanted, 1, static_cast<int>(timeout.count())) <= 0) return true;
  std::array<char, 65536> buffer{};
  const ssize_t count = ::read(events_, buffer.data(), buffer.size());
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  if (count == 0) return false;
  partial_.append(buffer.data(), static_cast<std::size_t>(count));
  std::size_t begin = 0;
  for (std::size_t end; (end = partial_.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(partial_.substr(begin, end - begin));
  partial_.erase(0, begin);
  return partial_.size() <= kMaxMessageBytes;
}

void ChildProcess::ask_to_end() {
  if (process_ > 0) ::kill(process_, SIGTERM);
}

void ChildProcess::kill() {
  if (process_ <= 0) return;
  ::kill(-process_, SIGKILL);
  ::kill(process_, SIGKILL);
}

ChildEnd ChildProcess::wait() {
  int status = 0;
  struct rusage usage {};
  while (::wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  process_ = -1;
  ChildEnd end;
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  end.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.peak_memory_bytes = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
  return end;
}

}  // namespace toile
