// SPDX-License-Identifier: GPL-3.0-or-later
// What the sub-benchmarks of toile-bench share: CPU clocks, medians of repeats, tables.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace toile::bench {

double cpu_seconds();   // of this process, all threads
double wall_seconds();  // monotonic
double peak_memory_mb();
// From here on peak_memory_mb() counts anew. False where the system does not let it.
bool forget_peak_memory();

struct Timing {
  double median = 0, least = 0, most = 0;  // CPU seconds
};
Timing time_cpu(int repeats, const std::function<void()>& work);
double median(std::vector<double> values);  // the upper one of an even number; 0 of none

// Slope of log(time) over log(size): the growth exponent.
double growth_exponent(const std::vector<double>& sizes, const std::vector<double>& times);

// Columns aligned on stdout; `csv` also writes them comma-separated to that file when it is not empty.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void print(const std::string& csv = {}) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};
std::string fixed(double value, int digits);

inline constexpr double kMm = 1e3, kPercent = 100.0;
std::string mm(double metres, int digits = 1);
std::string percent(double share, int digits = 1);

struct Arguments {
  std::vector<std::string> words;  // after the benchmark's name
  std::string csv;                 // --csv FILE
  std::string svg;                 // --svg FILE, where a benchmark draws a plot
  int repeats = 5;                 // --repeats N
};

// Each returns a process exit code. Add yours here and to the list in main.cpp.
int bench_inputs(const Arguments& arguments);
int bench_derive(const Arguments& arguments);
int bench_drape(const Arguments& arguments);
int bench_view(const Arguments& arguments);
int bench_alter(const Arguments& arguments);
int bench_where(const Arguments& arguments);
int bench_worn(const Arguments& arguments);
int bench_alteration(const Arguments& arguments);
int bench_examples(const Arguments& arguments);
int bench_mannequins(const Arguments& arguments);
int bench_panels(const Arguments& arguments);
int bench_pictures(const Arguments& arguments);
int bench_fabrics(const Arguments& arguments);
int bench_ladder(const Arguments& arguments);
int bench_oracle(const Arguments& arguments);
int bench_register(const Arguments& arguments);
int bench_queue(const Arguments& arguments);
int bench_stages(const Arguments& arguments);
int bench_transport(const Arguments& arguments);

}  // namespace toile::bench
