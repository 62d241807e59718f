// SPDX-License-Identifier: GPL-3.0-or-later
// ledger [--slow] [--filter GTEST_FILTER] [PROGRAM...]
// Every comparison with an exact or independent answer that the tests make: what it tolerates and what was reached.
// Runs the test programs beside this one (those named, or all of them; without their slow suites unless told) and
// prints for each thing that a test compares the worst of its comparisons.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <unistd.h>

#include "engine/core/text.h"
#include "tests/bench/proof.h"

namespace toile::bench {
namespace {

namespace fs = std::filesystem;

struct LedgerRequest {
  std::vector<std::string> programs;
  std::string filter = "-Slow*";  // of GoogleTest; empty: everything
};

LedgerRequest ledger_request(const std::vector<std::string>& words) {
  LedgerRequest request;
  const fs::path folder = fs::canonical("/proc/self/exe").parent_path();
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == "--slow")
      request.filter.clear();
    else if (words[i] == "--filter" && i + 1 < words.size())
      request.filter = words[++i];
    else
      request.programs.push_back(folder / words[i]);
  if (!request.programs.empty()) return request;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with("test_")) request.programs.push_back(entry.path());
  std::sort(request.programs.begin(), request.programs.end());
  return request;
}

struct Comparison {
  double value = 0.0, expected = 0.0, tolerance = 0.0;
  int times = 0;

  double reached() const { return std::abs(value - expected); }
  double used() const { return tolerance > 0 ? reached() / tolerance : reached() > 0 ? 1e9 : 0.0; }
};

std::string quoted(const std::string& text) {
  std::string safe(1, '\'');
  for (const char c : text)
    if (c == '\'')
      safe.append("'\\''");
    else
      safe.push_back(c);
  safe.push_back('\'');
  return safe;
}

// By test and what it compares, in order of their names.
using Ledger = std::map<std::pair<std::string, std::string>, Comparison>;

Ledger read_ledger(const std::string& file) {
  Ledger ledger;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::string test, what, with, value, expected, tolerance;
    for (std::string* cell : {&test, &what, &with, &value, &expected, &tolerance}) std::getline(cells, *cell, '\t');
    const Comparison read{std::atof(value.c_str()), std::atof(expected.c_str()), std::atof(tolerance.c_str()), 0};
    Comparison& kept = ledger[{test, what}];
    const int times = kept.times + 1;
    if (kept.times == 0 || !(read.used() <= kept.used())) kept = read;
    kept.times = times;
  }
  return ledger;
}

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

int bench_ledger(const Arguments& arguments) {
  const LedgerRequest request = ledger_request(arguments.words);
  const std::string file = fs::temp_directory_path() / print_text("toile_ledger_%d", ::getpid());
  setenv("TOILE_LEDGER", file.c_str(), 1);
  Table table({"program", "test", "compared", "times", "tolerance", "reached", "used %"});
  int failed = 0, comparisons = 0, over = 0;
  for (const std::string& program : request.programs) {
    fs::remove(file);
    std::string command = quoted(program);
    command.append(" --gtest_brief=1");
    if (!request.filter.empty()) command.append(" --gtest_filter=").append(quoted(request.filter));
    const int status = std::system(command.c_str());
    failed += status != 0;
    for (const auto& [key, worst] : read_ledger(file)) {
      table.add({fs::path(program).filename(), key.first, key.second.substr(0, 60), std::to_string(worst.times),
                 figure(worst.tolerance), figure(worst.reached()), figure(100 * worst.used())});
      comparisons += worst.times;
      over += worst.used() > 1.0;
    }
  }
  fs::remove(file);
  table.print(arguments.csv);
  std::printf("%d comparisons, %d over their tolerance, %d of %zu programs failed\n", comparisons, over, failed,
              request.programs.size());
  return failed > 0 ? 1 : 0;
}

}  // namespace toile::bench
