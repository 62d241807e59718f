// SPDX-License-Identifier: GPL-3.0-or-later
// batch [GARMENT] [--bodies NAME,NAME,...] [--triangles N]: one garment for many bodies of one family with the stages
// shared, against each job alone: CPU seconds of every body. --count N: for N bodies drawn from seeds instead, of which
// every tenth is also altered alone; the mean cost of a further body over that of a job alone.
// threads [GARMENT] [--bodies NAME] [--triangles N]: one job with two threads, and two and four jobs at once, against
// one job with one. Both tell whether the files are the same to the last byte.
#include <cstdio>
#include <thread>

#include "engine/core/error.h"
#include "tests/bench/derive.h"
#include "tests/bench/proof.h"
#include "tests/bench/random_body.h"
#include "tests/bench/whole_job.h"
#include "tests/bench/words.h"
#include "tests/support/shared_data.h"

namespace toile::bench {
namespace {

struct BatchRequest {
  std::string garment = "leggings_tight";
  std::vector<std::string> bodies = {"ggg_mean_female", "ggg_small_female", "ggg_male_extra", "ggg_large_male"};
  int triangles = 10000;
  int count = 0;  // of random bodies; 0: those that are named
};

BatchRequest batch_request(Words words) {
  BatchRequest request;
  request.triangles = words.integer("--triangles").value_or(request.triangles);
  request.count = words.integer("--count").value_or(request.count);
  request.bodies = words.list("--bodies").value_or(request.bodies);
  if (!words.rest().empty()) request.garment = words.rest().back();
  return request;
}

bool same_files(const std::vector<OutputFile>& a, const std::vector<OutputFile>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].name != b[i].name || a[i].bytes != b[i].bytes) return false;
  return true;
}

test::Scene batch_scene(const BatchRequest& request, const std::string& body) {
  return test::named_scene(request.garment + ":" + body);
}

AlterOptions batch_options(const BatchRequest& request) {
  AlterOptions options;
  options.triangles = request.triangles;
  options.outputs = {"altered_pattern.svg", "ticket.json", "target_pattern.json"};
  return options;
}

constexpr int kAlone = 10;  // of so many random bodies one is also altered alone

class Batch {
 public:
  explicit Batch(AlterOptions options) : options_(std::move(options)) {}

  // The first body pays for the shared stages and does not count as a further one.
  void add(const test::Scene& scene, bool also_alone) try {
    const JobRun shared = run_job(scene, options_, stages_.get());
    int reused = 0;
    for (const StageCost& stage : shared.stages) reused += stage.reused;
    std::vector<std::string> row = {scene.target.name, "-", fixed(shared.cpu_s, 2), "-", std::to_string(reused), "-"};
    if (reused > 0) further_.push_back(shared.cpu_s);
    if (also_alone) {
      const JobRun alone = run_job(scene, options_);
      const bool same = same_files(alone.files, shared.files);
      all_same_ = all_same_ && same;
      row[1] = fixed(alone.cpu_s, 2), row[3] = fixed(100 * shared.cpu_s / alone.cpu_s, 0), row[5] = same ? "yes" : "NO";
      if (reused > 0) alone_.push_back(alone.cpu_s), compared_.push_back(shared.cpu_s);
    }
    table_.add(std::move(row));
  } catch (const Error& error) {
    table_.add({scene.target.name, "-", "-", "-", "-", error.message});
  }

  int print(const Arguments& arguments) const {
    table_.print(arguments.csv);
    if (!alone_.empty())
      std::printf(
          "a further body costs %.2f CPU s in the mean of %zu; those also altered alone %.2f against %.2f: %.1f %%\n",
          mean(further_), further_.size(), mean(compared_), mean(alone_), 100 * mean(compared_) / mean(alone_));
    return all_same_ ? 0 : 1;
  }

 private:
  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }

  AlterOptions options_;
  std::unique_ptr<StageCache> stages_ = stage_store({});
  Table table_{{"body", "alone CPU s", "in the batch CPU s", "share %", "stages reused", "same bytes"}};
  std::vector<double> further_, compared_, alone_;  // CPU s
  bool all_same_ = true;
};

}  // namespace

int bench_batch(const Arguments& arguments) {
  const BatchRequest request = batch_request(Words(arguments.words));
  Batch batch(batch_options(request));
  if (request.count == 0) {
    for (const std::string& body : request.bodies) batch.add(batch_scene(request, body), true);
  } else {
    const std::vector<TriangleMesh> family = shared_family();
    test::Scene scene = batch_scene(request, request.bodies.front());
    for (int number = 0; number < request.count; ++number) {
      scene.target = random_body(number, family);
      batch.add(scene, number % kAlone == 1);
    }
  }
  return batch.print(arguments);
}

int bench_threads(const Arguments& arguments) {
  BatchRequest request = batch_request(Words(arguments.words));
  const AlterOptions options = batch_options(request);
  const test::Scene scene = batch_scene(request, request.bodies.front());
  const JobRun alone = run_job(scene, options);
  Table table({"jobs at once", "wall s", "CPU s a job", "jobs a wall second over one", "same bytes"});
  table.add({"1", fixed(alone.wall_s, 2), fixed(alone.cpu_s, 2), "1.00", "yes"});
  const JobRun two = run_job(scene, options, nullptr, 2);
  table.add({"1, two threads", fixed(two.wall_s, 2), fixed(two.cpu_s, 2), fixed(alone.wall_s / two.wall_s, 2),
             same_files(two.files, alone.files) ? "yes" : "NO"});
  for (const int count : {2, 4}) {
    std::vector<JobRun> runs(static_cast<std::size_t>(count));
    const double wall = wall_seconds(), cpu = cpu_seconds();
    std::vector<std::thread> threads;
    for (JobRun& run : runs) threads.emplace_back([&] { run = run_job(scene, options); });
    for (std::thread& thread : threads) thread.join();
    const double took = wall_seconds() - wall;
    bool same = true;
    for (const JobRun& run : runs) same = same && same_files(run.files, alone.files);
    table.add({std::to_string(count), fixed(took, 2), fixed((cpu_seconds() - cpu) / count, 2),
               fixed(count * alone.wall_s / took, 2), same ? "yes" : "NO"});
  }
  table.print(arguments.csv);
  return 0;
}

}  // namespace toile::bench
