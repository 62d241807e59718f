// SPDX-License-Identifier: GPL-3.0-or-later
// stress [--scenes N] [--seed S] [--kind KIND] [--limit SECONDS] [--all]
// The long run of the stress suite (tests/stress): scene after scene, each in a process of its own, so that a crash or
// a hang (more CPU seconds than the limit) is one more bad scene and not the end. Prints every bad scene and every one
// that took over half the limit with its seed, and how many were done, refused and bad; --all prints the refused ones
// too. Ends with 1 when a scene was bad or more than 1 % of those inside the human range were refused.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/core/archive.h"
#include "tests/bench/proof.h"
#include "tests/bench/words.h"
#include "tests/stress/stress_scene.h"

namespace toile::stress {

template <class A>
void archive(A& a, Outcome& v) {
  auto& [kind, what, human_range, ending, error, wrong, cpu_s] = v;
  a(kind, what, human_range, ending, error, wrong, cpu_s);
}

}  // namespace toile::stress

namespace toile::bench {
namespace {

using stress::Ending;
using stress::Outcome;

constexpr rlim_t kMemory = rlim_t{3} << 30;  // bytes: a scene that wants more than 3 GB is out of hand

struct StressRequest {
  int scenes = 200, limit = 60;  // CPU s: a scene runs its job up to four times
  std::uint64_t seed = 1;
  std::string kind;
  bool all = false;
};

StressRequest stress_request(Words words) {
  StressRequest request;
  request.scenes = words.integer("--scenes").value_or(request.scenes);
  request.limit = std::max(1, words.integer("--limit").value_or(request.limit));
  if (const auto seed = words.text("--seed")) request.seed = std::strtoull(seed->c_str(), nullptr, 10);
  request.kind = words.text("--kind").value_or("");
  request.all = words.flag("--all");
  return request;
}

[[noreturn]] void run_in_child(const StressRequest& request, std::uint64_t seed, int pipe) {
  const auto seconds = static_cast<rlim_t>(request.limit);
  const rlimit cpu{seconds, seconds + 5}, memory{kMemory, kMemory}, core{0, 0};
  setrlimit(RLIMIT_CPU, &cpu);
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &core);
  const Bytes bytes = to_bytes(request.kind.empty() ? stress::run_scene(seed) : stress::run_scene(request.kind, seed));
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t wrote = write(pipe, bytes.data() + at, bytes.size() - at);
    if (wrote <= 0) break;
    at += static_cast<std::size_t>(wrote);
  }
  std::fflush(nullptr);
  _exit(0);
}

Bytes read_pipe(int pipe) {
  Bytes bytes;
  std::uint8_t buffer[4096];
  for (ssize_t got; (got = ::read(pipe, buffer, sizeof buffer)) > 0;) bytes.insert(bytes.end(), buffer, buffer + got);
  return bytes;
}

Outcome run_apart(const StressRequest& request, std::uint64_t seed) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_in_child(request, seed, ends[1]);
  }
  close(ends[1]);
  const Bytes bytes = read_pipe(ends[0]);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !bytes.empty()) return from_bytes<Outcome>(bytes);
  Outcome outcome;
  outcome.kind = request.kind.empty() ? "?" : request.kind;
  outcome.cpu_s = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
  const bool hung = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  outcome.fail(hung ? "hang: more CPU seconds than the limit"
                    : "crash: ended by signal " + std::to_string(WIFSIGNALED(status) ? WTERMSIG(status) : 0));
  return outcome;
}

struct Count {
  int scenes = 0, done = 0, refused = 0, bad = 0, in_range = 0, refused_in_range = 0;
  std::vector<double> cpu;
};

void count(const Outcome& outcome, Count& c) {
  ++c.scenes;
  c.done += outcome.ending == Ending::Done;
  c.refused += outcome.ending == Ending::Refused;
  c.bad += outcome.ending == Ending::Bad;
  c.in_range += outcome.human_range;
  c.refused_in_range += outcome.human_range && outcome.ending == Ending::Refused;
  c.cpu.push_back(outcome.cpu_s);
}

void tell(const StressRequest& request, std::uint64_t seed, const Outcome& outcome) {
  const bool odd = outcome.ending == Ending::Refused && outcome.human_range;
  const bool slow = outcome.cpu_s > 0.5 * request.limit;
  if (outcome.ending != Ending::Bad && !odd && !slow && !(request.all && outcome.ending == Ending::Refused)) return;
  const char* ended = outcome.ending == Ending::Bad ? "BAD" : outcome.ending == Ending::Done ? "slow" : "refused";
  std::printf("%s seed %llu (%s%s, %.1f s): %s\n", ended, static_cast<unsigned long long>(seed), outcome.kind.c_str(),
              outcome.human_range ? ", human range" : "", outcome.cpu_s, outcome.what.c_str());
  if (!outcome.error.empty()) std::printf("    %s\n", outcome.error.c_str());
  for (const std::string& wrong : outcome.wrong) std::printf("    %s\n", wrong.c_str());
  std::fflush(stdout);
}

void add_row(Table& table, const std::string& kind, Count c) {
  std::sort(c.cpu.begin(), c.cpu.end());
  double sum = 0.0;
  for (const double cpu : c.cpu) sum += cpu;
  table.add({kind, std::to_string(c.scenes), std::to_string(c.done), std::to_string(c.refused), std::to_string(c.bad),
             std::to_string(c.in_range), std::to_string(c.refused_in_range), fixed(c.cpu[c.cpu.size() / 2], 2),
             fixed(c.cpu.back(), 2), fixed(sum, 0)});
}

}  // namespace

int bench_stress(const Arguments& arguments) {
  const StressRequest request = stress_request(Words(arguments.words));
  std::map<std::string, Count> kinds;
  Count all;
  std::map<std::string, int> refusals;
  for (int i = 0; i < request.scenes; ++i) {
    const std::uint64_t seed = request.seed + static_cast<std::uint64_t>(i);
    const Outcome outcome = run_apart(request, seed);
    tell(request, seed, outcome);
    count(outcome, kinds[outcome.kind]);
    count(outcome, all);
    if (outcome.ending == Ending::Refused) ++refusals[outcome.error.substr(0, outcome.error.find(':'))];
  }
  Table table(
      {"kind", "scenes", "done", "refused", "bad", "human range", "of them refused", "CPU s median", "most", "in all"});
  for (const auto& [kind, c] : kinds) add_row(table, kind, c);
  if (all.scenes > 0) add_row(table, "all", all);
  table.print(arguments.csv);
  for (const auto& [code, times] : refusals) std::printf("refused as %s: %d\n", code.c_str(), times);
  return all.bad > 0 || 100 * all.refused_in_range > all.in_range ? 1 : 0;
}

}  // namespace toile::bench
